#pragma once
// A sample in contact, whatever it touches: where forces act on both sides, and the friction there during a step.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/contact_law.h"
#include "core/contact/skin_samples.h"
#include "core/forces/compensated_sum.h"
#include "core/forces/force_term.h"
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
/// The acceleration per force along the direction of the force.
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

  ContactSite() = default;
  /// The place of a sample alone, as with an obstacle.
  explicit ContactSite(const SkinSample& sample) {
    for (const std::uint32_t i : sample.corners()) add(i, 1.0 / static_cast<double>(sample.count));
  }

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
  /// of += |w| size at each node.
  void add_size_to(std::span<double> of, double size) const {
    for (std::size_t k = 0; k < count; ++k) of[nodes[k]] += std::abs(weights[k]) * size;
  }
  /// The acceleration of the difference per force [1/kg], for any direction if no axis is held.
  double mobility(std::span<const double> inverse_mass, const HeldVertices& held) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += weights[k] * weights[k] * mobility_of(nodes[k], inverse_mass, held);
    return sum;
  }
  /// The acceleration of the difference per force along the direction of the force.
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

struct BodyTouch;

/// A sample inside an obstacle or a body. Contacts lists those of both.
struct Touch {
  /// In place of the number of an obstacle, where a body is touched.
  static constexpr std::uint32_t body = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t sample = 0;       // place among the samples of its term
  std::uint32_t obstacle = body;  // the one that it is inside of
  const ContactLaw* law = nullptr;
  double area = 0.0;                   // [m^2] that it stands for
  double depth = 0.0;                  // [m], above 0
  Eigen::Vector3d normal{0, 0, 0};     // of length 1: the force on the sample is along it
  const BodyTouch* in_body = nullptr;  // the nearest exit from a body; null with an obstacle
};

/// What a run reports of its contacts: with obstacles, between bodies, or of both.
struct ContactState {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::size_t contacts = 0;                 // pairs of a sample and what it is inside of
  double area = 0.0;                        // [m^2] that these stand for; between bodies half of the area of each
  double energy = 0.0;                      // [J]
  double deepest = 0.0;                     // [m]; 0 without a contact
  double deepest_share = 0.0;               // the largest depth over the `depth` of its law
  std::uint32_t sample = none;              // the deepest, the first of equal ones
  std::uint32_t obstacle = none;            // that it is inside of; or
  std::uint32_t from = 0, into = 0;         // its group, and that of the body that it is inside of
  std::vector<Eigen::Vector3d> force_on{};  // [N] on each obstacle
  std::size_t out_of_reach = 0;             // samples inside a body without an exit in reach: these have no contact
  std::uint32_t lost = none;                // the first of them
  std::size_t inverted = 0;                 // candidates that were ignored because they are turned inside out
};

/// A constant friction force during a step, between a sample and an obstacle, or a place in a body with which it
/// coincides half way through the step.
struct ContactFriction {
  std::uint32_t sample = 0, obstacle = Touch::body;
  std::uint32_t tetrahedron = 0;   // that the sample is inside of, in a body
  ContactSite site{};              // the sample, less its place in the tetrahedron
  Eigen::Vector3d force{0, 0, 0};  // [N] on the sample
  Eigen::Vector3d from{0, 0, 0};   // [m] the difference of the site before the step

  bool is_of_bodies() const { return obstacle == Touch::body; }
  /// Writes or reads it between steps: the next step starts from it.
  template <class Archive>
  void state(Archive& archive) {
    archive(sample, obstacle, force);
  }
};

/// The friction forces of a contact term during a step, with the energy - F . (difference - from), so that every
/// integrator treats them as any other force. ContactImpulses sets them, in the order of samples.
struct FrozenFriction {
  std::vector<ContactFriction> rows{};

  void add_forces(std::span<Eigen::Vector3d> force) const {
    for (const ContactFriction& f : rows) f.site.add_to(force, f.force);
  }
  void add_force_sizes(std::span<double> size) const {
    for (const ContactFriction& f : rows) f.site.add_size_to(size, f.force.norm());
  }
  /// Of the samples first, first + stride, ...
  void add_energy(std::span<const Eigen::Vector3d> x, std::size_t first, std::size_t stride,
                  CompensatedSum& sum) const {
    for (const ContactFriction& f : rows)
      if (f.sample >= first && (f.sample - first) % stride == 0) sum.add(-f.force.dot(f.site.difference(x) - f.from));
  }
  /// As every vertex moves on by `scale` times `step`.
  void add_change(std::span<const Eigen::Vector3d> step, double scale, EnergyChange& sum) const {
    for (const ContactFriction& f : rows) {
      const Eigen::Vector3d way = scale * f.site.difference(step);
      sum.value -= f.force.dot(way);
      sum.sizes += f.force.norm() * way.norm();
    }
  }
};

}  // namespace dartboard
