#pragma once
// A dissociation in every step, timed in this process.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "core/plain/problem.h"

namespace dartboard {

/// A body that changes, and what one sample of its tasks does.
struct ChangingCounts {
  std::string changing;  // the body
  std::size_t tetrahedra = 0, springs = 0;
  int steps = 1;              // in a sample, each with a dissociation where the task has any
  std::size_t faces = 0;      // that may be dissociated before the body is made anew
  std::size_t differing = 0;  // after some of them: bits of the ways to follow, and forces of a fresh body
};
void to_json(nlohmann::json& json, const ChangingCounts& counts);
void from_json(const nlohmann::json& json, ChangingCounts& counts);

/// The tasks of a body; they are named "BODY: changed" ...
namespace changing_task {
inline constexpr const char *followed = ": a dissociation and a step",     // embeddings and views follow
    *alone = ": the step alone",                                           // of the same body
        *ends_anew = ": a dissociation, all ends anew, and a step",        // embeddings are adapted
            *all_anew = ": a dissociation, all columns anew, and a step",  // masses and springs, too
                *naive = ": the naive graph, the step alone";
}

/// The paper's body with damping, and boxes in grid order of 10^4 to so many tetrahedra.
std::vector<std::string> changing_bodies(std::size_t largest);

struct ChangingPlan {
  std::size_t largest = 1'000'000;  // tetrahedra
  int process = 0;
  int rounds = 20;  // a fifth of them for the largest box
  std::uint64_t seed = 1;
  // Bodies of up to so many tetrahedra are made anew for each sample, so that all samples change the same body; larger
  // ones go on with other faces.
  std::size_t most_made_anew = 20'000;
};

/// Change and step each body in all ways, which must end in the same bits, and compare it with the graph of its
/// present cells.
void compare_changing(const ChangingPlan& plan, const std::function<void(const ChangingCounts&)>& sink);

/// Take turns in this process, body by body, and report every sample. The three tasks with dissociations leave the same
/// bits in each round.
void measure_changing(const ChangingPlan& plan, const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
