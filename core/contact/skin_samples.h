#pragma once
// Samples of the boundary of a body for contact: places with weights.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/forces/force_term.h"

namespace dartboard {

/// A place on the boundary, the mean of its nodes: a vertex, or the middle of a face of three or four corners or of a
/// link.
struct SkinSample {
  std::array<std::uint32_t, 4> nodes{};  // vertex numbers; those from `count` on are 0
  std::uint32_t count = 0;               // 1 to 4
  double area = 0.0;                     // [m^2] of the boundary at rest that it stands for, above 0

  std::span<const std::uint32_t> corners() const { return {nodes.data(), count}; }
  friend bool operator==(const SkinSample&, const SkinSample&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(nodes, count, area);
  }
};

/// The mean of `of(node)` over its nodes.
template <class Of>
Eigen::Vector3d mean_of(const SkinSample& sample, const Of& of) {
  const auto& n = sample.nodes;
  if (sample.count == 1) return of(n[0]);
  if (sample.count == 3) return (of(n[0]) + of(n[1]) + of(n[2])) / 3.0;
  if (sample.count == 2) return 0.5 * (of(n[0]) + of(n[1]));
  return 0.25 * ((of(n[0]) + of(n[1])) + (of(n[2]) + of(n[3])));
}

/// Visits a stiffness of its place [N/m] as one of its nodes, each of which has 1/n of the place and of the force.
inline void visit_tangent(const SkinSample& sample, const Eigen::Matrix3d& stiffness,
                          const ForceTerm::VisitTangent& visit) {
  std::array<Eigen::Matrix3d, 10> blocks;
  const std::size_t count = sample.count * (sample.count + 1) / 2;
  std::fill_n(blocks.begin(), count, stiffness / static_cast<double>(sample.count * sample.count));
  visit(sample.corners(), std::span(blocks).first(count));
}

}  // namespace dartboard
