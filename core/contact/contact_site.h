#pragma once
// The site of a contact between bodies: nodes of both sides with signed weights.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dartboard {

/// A place of one side less a place of the other, each a mean of its nodes: weights add up to 1 on one side, to -1 on
/// the other. A force F on it is w F on each node, so that forces add up to zero, and torques too if the two places
/// coincide or F is along the line between them.
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
};

}  // namespace dartboard
