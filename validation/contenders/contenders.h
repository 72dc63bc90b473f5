#pragma once
// The contenders: one row per way of carrying and walking the same body.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/problem.h"
#include "core/time/system/spring_system.h"
#include "validation/contenders/contender_body.h"

namespace dartboard {

enum class Carrier { core_map, adjacency_graph, cgal_map };

struct Contender {
  std::string id;       // for the command line and the raw samples
  std::string what;     // one line for readers
  std::string section;  // of the paper; empty for contenders that the paper does not have
  double paper_ms;      // per step, section 5; 0 where the paper gives none
  Carrier carrier;      // the walks of the core must agree bit for bit, the others within the summation bound
  std::function<std::unique_ptr<ContenderBody>(const Problem&)> make;
};

/// All contenders, in the order in which they are printed; the baseline of every ratio is `graph`.
std::span<const Contender> contenders();

inline constexpr std::string_view baseline_id = "graph";

/// Springs and ambient drag on each point [N], by the forces of core/time; `point` is that of each vertex.
std::vector<Eigen::Vector3d> spring_and_drag_forces(SpringSystem system, std::span<const Eigen::Vector3d> x,
                                                    std::span<const Eigen::Vector3d> v,
                                                    std::span<const std::uint32_t> point);

/// throws  InputError that lists the known ids
const Contender& contender(std::string_view id);

}  // namespace dartboard
