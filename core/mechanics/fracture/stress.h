#pragma once
// The inner stress at a vertex, from the springs around it: what decides where and along which face a body tears.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/forces/force_term.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/plain/error.h"

namespace dartboard {

/// What a spring adds to the virial of each of its two ends [J]: 1/2 T l (u u^T), tension positive; zero for zero
/// length. Exchanging the ends leaves the bits.
///
/// T is the elastic tension k (l - L) alone: stress is then a function of the positions. With the damping in it, a
/// threshold would be passed by the shock that a tear itself sends through its neighbours, and the sooner the smaller
/// the time step.
inline Eigen::Matrix3d spring_virial(const Spring& spring, const Eigen::Vector3d& dx) {
  const double length = std::sqrt(dx.squaredNorm());
  if (length == 0.0) return Eigen::Matrix3d::Zero();
  const double scale = 0.5 * spring.stiffness * (length - spring.rest_length) / length;
  Eigen::Matrix3d virial;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) virial(i, j) = virial(j, i) = (scale * dx[i]) * dx[j];
  return virial;
}

/// Of what it was at rest, the volume at a vertex counts as this at least: cells that are squeezed flat or turned
/// inside out have no stress of Cauchy's.
inline constexpr double least_volume = 0.01;

/// The stress at vertex k [Pa] (of a surface [N/m]), symmetric, tension positive:
///
///     sigma = (1 / V) * sum over the springs around it of 1/2 T l (u u^T)
///
/// or with elements, over those around it, a fourth of their volume times J times Cauchy's stress; of a surface a third
/// or a fourth of their area. Springs within the cells around it add what they have over the number of the cell's
/// vertices.
///
/// V is the volume (area) of the vertex, its share of each cell as eq. (1) has it: of elements as it is now, so that
/// sigma is their mean Cauchy stress; of cells of springs as it was at rest, so that sigma is their virial per volume
/// at rest. The sum of V sigma over all vertices is the virial of the body, and a uniform stress is the same at every
/// vertex of a regular lattice. Springs are found by walking the edges around the vertex, and summed by edge number, so
/// that the order of the walk leaves no trace in the bits.
template <class Map>
Eigen::Matrix3d vertex_stress(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k);

/// The volume at rest of every vertex [m^3] (of a surface its area): in a body of one density its mass over that.
struct RestVolumes {
  std::span<const double> mass;  // [kg] by vertex number
  double density;
  std::span<const double> of_vertex{};  // where densities differ

  double operator[](std::size_t k) const { return of_vertex.empty() ? mass[k] / density : of_vertex[k]; }
};
/// Of the vertices of a body; `room` holds them where densities differ.
/// cost    O(1), or O(vertices) of a body of several materials
template <class Map>
RestVolumes rest_volumes(const MassSpringBody<Map, Held::by_every_dart>& body, std::vector<double>& room) {
  if (body.materials.empty()) return {body.vertices.mass, body.material.density};
  room.clear();
  for (const Dart d : body.vertices.dart) room.push_back(body.volume_of(Vertex{d}));
  return {body.vertices.mass, 0.0, room};
}

/// The same for all vertices at once, into `stress` by vertex number, to the bit: one pass over the springs and one
/// over the vertices, for use in every time step.
///
/// pre     ends, springs by edge number, volumes, position by vertex number, as the body has them; the terms of its system
/// cost    O(springs + vertices); no allocation once `stress` has had its size
void vertex_stresses(std::span<const std::array<std::uint32_t, 2>> ends, SpringSpan springs, const RestVolumes& volumes,
                     std::span<const Eigen::Vector3d> position, std::vector<Eigen::Matrix3d>& stress,
                     ForceTerms terms = {});

/// The stress of this vertex is not finite.
struct StressError : SolverError {
  explicit StressError(std::uint32_t which);
  std::uint32_t vertex;
};

/// The largest eigenvalue of a stress and its direction.
struct PrincipalStress {
  double value;               // [Pa], tension positive
  Eigen::Vector3d direction;  // a unit vector; of the two, the one whose component of largest magnitude is positive
};

/// Where the largest eigenvalue is repeated, the direction is one of those it has, the same for the same bits.
///
/// throws  SolverError if the stress is not finite
PrincipalStress principal_stress(const Eigen::Matrix3d& stress);

/// What pictures show of a stress [Pa].
struct StressMeasures {
  double largest_principal;  // the largest eigenvalue, tension positive: as principal_stress, to the bit
  double largest_magnitude;  // of an eigenvalue
  double von_mises;          // sqrt of half the sum of the squares of the eigenvalues' differences
};
/// All are infinite where the stress is not finite.
StressMeasures measures_of(const Eigen::Matrix3d& stress);

/// The largest principal stress [Pa] of a body's vertices: 0 when there is none, infinite where one is not finite.
double largest_principal_stress(std::span<const Eigen::Matrix3d> stresses);

extern template Eigen::Matrix3d vertex_stress(const MassSpringBody<Map2, Held::by_every_dart>&, std::uint32_t);
extern template Eigen::Matrix3d vertex_stress(const MassSpringBody<Map3, Held::by_every_dart>&, std::uint32_t);
extern template Eigen::Matrix3d vertex_stress(const MassSpringBody<TetMap, Held::by_every_dart>&, std::uint32_t);

}  // namespace dartboard
