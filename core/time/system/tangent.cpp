#include "core/time/system/tangent.h"

#include <algorithm>
#include <cmath>

namespace dartboard {

SpringTangent tangent_of(const Spring& spring, const Eigen::Vector3d& dx, Compression compression) {
  const double length = std::sqrt(dx.squaredNorm());
  if (length == 0.0) return {Eigen::Vector3d::Zero(), spring.stiffness, spring.stiffness, 0.0};
  const double across = spring.stiffness * ((length - spring.rest_length) / length);
  const bool project = compression == Compression::projected && across < 0.0;
  return {dx / length, spring.stiffness, project ? 0.0 : across, spring.damping};
}

void evaluate_tangents(const SpringSystem& system, std::span<const Eigen::Vector3d> x, Compression compression,
                       std::vector<SpringTangent>& tangents) {
  tangents.resize(system.springs.size());
  for (std::size_t e = 0; e < tangents.size(); ++e) {
    const auto [a, b] = system.ends[e];
    tangents[e] = tangent_of(system.springs[e], x[b] - x[a], compression);
  }
}

void multiply_stiffness(const SpringSystem& system, std::span<const SpringTangent> tangents,
                        std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) {
  // In large systems the tangents come from memory, and a processor looks ahead to the end of a page only.
  constexpr std::size_t ahead = 32;
  for (Eigen::Vector3d& p : y) p.setZero();
  for (std::size_t e = 0; e < tangents.size(); ++e) {
    __builtin_prefetch(tangents.data() + std::min(e + ahead, tangents.size() - 1));
    const auto [a, b] = system.ends[e];
    const SpringTangent& t = tangents[e];
    const Eigen::Vector3d dx = x[b] - x[a];
    const Eigen::Vector3d f = t.across * dx + ((t.along - t.across) * t.direction.dot(dx)) * t.direction;
    y[a] -= f;
    y[b] += f;
  }
  for (std::size_t i = 0; i < y.size(); ++i)
    if (system.fixed[i]) y[i].setZero();
  free_along_axes(system, y);
}

}  // namespace dartboard
