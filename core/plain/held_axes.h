#pragma once
// Axes along which a vertex is held while it moves along the others: a symmetry plane, a roller.

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace dartboard {

/// Bits 1, 2 and 4 for x, y and z.
using HeldAxes = std::uint8_t;
inline constexpr HeldAxes all_axes = 7;

inline bool holds(HeldAxes held, int axis) { return (held >> axis & 1) != 0; }

/// "x", "y and z"
inline std::string_view name(HeldAxes held) {
  constexpr std::string_view names[] = {"none", "x", "y", "x and y", "z", "x and z", "y and z", "x, y and z"};
  return names[held & all_axes];
}

/// The vector without its components along these axes.
inline Eigen::Vector3d free_part(HeldAxes held, const Eigen::Vector3d& v) {
  return {holds(held, 0) ? 0.0 : v.x(), holds(held, 1) ? 0.0 : v.y(), holds(held, 2) ? 0.0 : v.z()};
}

}  // namespace dartboard
