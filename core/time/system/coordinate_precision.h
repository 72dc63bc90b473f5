#pragma once
// Are coordinates so large that their rounding shows in the springs?

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// Where coordinates are rounded most, in units of a spring that ends there.
struct CoordinatePrecision {
  std::uint32_t edge, vertex;  // the spring, and that of its ends which is farther from the origin
  int axis;                    // of the largest coordinate of that end
  double coordinate;           // [m]
  double length;               // [m] of the spring, or its rest length where that is longer
  double relative;             // eps |x| / length
  template <class Archive>
  void state(Archive& archive) {
    archive(edge, vertex, axis, coordinate, length, relative);
  }
};
/// "coordinate x = 1e+10 m of vertex 3 is rounded by up to 2.2e-06 of the spring beside it (1 m); move the body to the
/// origin"
std::string to_string(const CoordinatePrecision& found);

/// Beyond this, what rounding leaves of lengths and forces is worth a warning: a run of D edge lengths from the origin
/// ends some 30 eps D from that at the origin, which a millionth makes 3e-5 edge lengths.
inline constexpr double coarse_coordinates = 1e-6;

/// The worst place, if eps |x| / length is above `bound` there.
/// cost    O(springs)
std::optional<CoordinatePrecision> find_coarse_coordinate(const SpringSystem& system,
                                                          std::span<const Eigen::Vector3d> x,
                                                          double bound = coarse_coordinates);

}  // namespace dartboard
