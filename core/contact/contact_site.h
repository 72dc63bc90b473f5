#pragma once
// The site of a contact: nodes of both sides with signed weights, and the effect of an impulse there.

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/plain/held_axes.h"

namespace dartboard {

/// Vertices that do not follow forces: 1 where one is fixed or driven, and the axes along which others are held. A
/// column may be empty; valid as long as both are.
class HeldVertices {
 public:
  HeldVertices() = default;
  template <class Column>
  requires std::convertible_to<const Column&, std::span<const std::uint8_t>> HeldVertices(
      const Column& fixed, std::span<const HeldAxes> axes = {})
      : fixed_(fixed), axes_(axes) {}

  bool is_still(std::size_t i) const { return !fixed_.empty() && fixed_[i] != 0; }
  HeldAxes axes(std::size_t i) const { return axes_.empty() ? HeldAxes{0} : axes_[i]; }

 private:
  std::span<const std::uint8_t> fixed_;
  std::span<const HeldAxes> axes_;
};

/// The acceleration of a vertex per force [1/kg].
inline double mobility_of(std::uint32_t i, std::span<const double> inverse_mass, const HeldVertices& held) {
  return held.is_still(i) ? 0.0 : inverse_mass[i];
}
/// The same along the direction of the force.
inline double mobility_along(std::uint32_t i, const Eigen::Vector3d& unit, std::span<const double> inverse_mass,
                             const HeldVertices& held) {
  const double all = mobility_of(i, inverse_mass, held);
  const HeldAxes axes = held.axes(i);
  return axes == 0 ? all : all * free_part(axes, unit).squaredNorm();
}
/// Adds an impulse over the mass of a vertex, or the part of it that no axis holds.
inline void push(std::uint32_t i, double over_mass, const Eigen::Vector3d& impulse, const HeldVertices& held,
                 std::span<Eigen::Vector3d> v) {
  if (const HeldAxes axes = held.axes(i); axes == 0)
    v[i] += over_mass * impulse;
  else
    v[i] += free_part(axes, over_mass * impulse);
}

/// A place of one side less a place of the other, each a mean of its nodes: weights add up to 1 on one side, to -1 on
/// the other, which has no nodes where it is an obstacle. A force F on it is w F on each node, so that forces add up to
/// zero, and torques too if the two places coincide or F is along the line between them.
struct ContactSite {
  std::array<std::uint32_t, 8> nodes{};
  std::array<double, 8> weights{};
  std::size_t count = 0;

  void add(std::uint32_t node, double weight) {
    nodes[count] = node;
    weights[count] = weight;
    ++count;
  }
  /// One place, or velocity, less the other.
  Eigen::Vector3d difference(std::span<const Eigen::Vector3d> of) const {
    Eigen::Vector3d sum(0, 0, 0);
    for (std::size_t k = 0; k < count; ++k) sum += weights[k] * of[nodes[k]];
    return sum;
  }
  /// of += w f at each node.
  void add_to(std::span<Eigen::Vector3d> of, const Eigen::Vector3d& f) const {
    for (std::size_t k = 0; k < count; ++k) of[nodes[k]] += weights[k] * f;
  }
  /// The acceleration of the difference per force [1/kg], for any direction if no axis is held.
  double mobility(std::span<const double> inverse_mass, const HeldVertices& held) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += weights[k] * weights[k] * mobility_of(nodes[k], inverse_mass, held);
    return sum;
  }
  /// The same along the direction of the force.
  double mobility_along(const Eigen::Vector3d& unit, std::span<const double> inverse_mass,
                        const HeldVertices& held) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k)
      sum += weights[k] * weights[k] * dartboard::mobility_along(nodes[k], unit, inverse_mass, held);
    return sum;
  }
  /// Applies a force or an impulse over the masses of the nodes.
  void push(const Eigen::Vector3d& impulse, std::span<const double> inverse_mass, const HeldVertices& held,
            std::span<Eigen::Vector3d> v) const {
    for (std::size_t k = 0; k < count; ++k)
      dartboard::push(nodes[k], weights[k] * mobility_of(nodes[k], inverse_mass, held), impulse, held, v);
  }
};

}  // namespace dartboard
