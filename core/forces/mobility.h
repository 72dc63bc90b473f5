#pragma once
// The changes of velocities by impulses.

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <span>

#include "core/plain/held_axes.h"

namespace dartboard {

/// Inverse masses [1/kg] by vertex, zero where it is fixed, and the axes along which vertices are held; empty where no
/// vertex is held. Valid as long as both columns.
class Mobility {
 public:
  template <class Column>
  requires std::convertible_to<const Column&, std::span<const double>> Mobility(
      const Column& inverse_mass, std::span<const HeldAxes> held_axes = {})
      : inverse_mass_(inverse_mass), held_axes_(held_axes) {}

  /// That of the vertices from `first` on, by their numbers from there.
  Mobility from(std::size_t first) const {
    return {inverse_mass_.subspan(first), held_axes_.empty() ? held_axes_ : held_axes_.subspan(first)};
  }

  double operator[](std::size_t i) const { return inverse_mass_[i]; }
  HeldAxes held_axes(std::size_t i) const { return held_axes_.empty() ? HeldAxes{0} : held_axes_[i]; }
  /// The velocity [m/s] that an impulse [N s] gives to vertex i.
  Eigen::Vector3d velocity_of(std::size_t i, const Eigen::Vector3d& impulse) const {
    return inverse_mass_[i] * free_part(held_axes(i), impulse);
  }
  /// The component of that velocity along the impulse, for an impulse of 1 N s along `unit` [1/kg].
  double along(std::size_t i, const Eigen::Vector3d& unit) const {
    return held_axes(i) == 0 ? inverse_mass_[i] : inverse_mass_[i] * free_part(held_axes(i), unit).squaredNorm();
  }

 private:
  std::span<const double> inverse_mass_;
  std::span<const HeldAxes> held_axes_;
};

}  // namespace dartboard
