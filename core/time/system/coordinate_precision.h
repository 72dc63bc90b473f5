#pragma once
// A check for coordinates so large that their rounding shows in springs and elements.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "core/time/system/spring_system.h"

namespace dartboard {

/// Where coordinates are rounded most, in units of a spring that ends there, or of the shortest edge of an element.
struct CoordinatePrecision {
  static constexpr std::uint32_t of_element = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t edge, vertex;  // the spring, or `of_element`; the end that is farther from the origin
  int axis;                    // of the largest coordinate of that end
  double coordinate;           // [m]
  double length;               // [m] of the spring, its rest length where that is longer, or of the element's edge
  double relative;             // eps |x| / length: the strain that rounding makes
  template <class Archive>
  void state(Archive& archive) {
    archive(edge, vertex, axis, coordinate, length, relative);
  }
};
/// "coordinate x = 1e+10 m of vertex 3 is rounded by up to 2.2e-06 of the spring next to it (1 m); move the body to the
/// origin"; "... of the shortest edge of an element next to it (1 m); ..."
std::string to_string(const CoordinatePrecision& found);

/// A larger relative rounding is worth a warning: a run at D edge lengths from the origin ends some 30 eps D from the
/// same run at the origin, which is 3e-5 edge lengths for a relative rounding of a millionth.
inline constexpr double coarse_coordinates = 1e-6;

/// The worst place, if eps |x| / length is above `bound` there. Elements count where one of their vertices has no
/// spring; for all others the springs are examined.
/// cost    O(springs), and O(vertices + pieces) of force terms
std::optional<CoordinatePrecision> find_coarse_coordinate(const SpringSystem& system,
                                                          std::span<const Eigen::Vector3d> x,
                                                          double bound = coarse_coordinates);

}  // namespace dartboard
