#pragma once
// The forces of a mass/spring body over any way of walking it (section 4.2).

#include <Eigen/Core>

#include "core/forces/spring_force.h"
#include "core/mechanics/mass_spring_body.h"

namespace dartboard {

/// Add the forces of all springs [N] into `vertices.force`.
///
/// Edges are visited in the order of the walk, so equal orders give equal bits.
template <class Walk, class Body>
void add_spring_forces(const Walk& walk, Body& body) {
  VertexColumns& v = body.vertices;
  SpringSpan(body.springs).visit([&](auto springs) {
    walk.for_each_edge(body, [&](std::uint32_t edge, std::uint32_t a, std::uint32_t b) {
      const Eigen::Vector3d f =
          spring_force(springs[edge], v.position[b] - v.position[a], v.velocity[b] - v.velocity[a]);
      v.force[a] += f;
      v.force[b] -= f;
    });
  });
}

/// Acceleration [m/s^2] of a vertex from its accumulated force, ambient viscosity and gravity; zero when fixed.
inline Eigen::Vector3d acceleration(const VertexColumns& v, const Eigen::Vector3d& gravity, std::uint32_t i) {
  if (v.fixed[i]) return Eigen::Vector3d::Zero();
  return (v.force[i] - v.viscosity[i] * v.velocity[i]) * v.inverse_mass[i] + gravity;
}

}  // namespace dartboard
