#pragma once
// The inner stress at a vertex, from the springs around it: it decides where and along which face a body tears.

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

/// Half the elastic force [N] of a spring whose second end is at dx from the first, towards that end if it is
/// stretched.
inline Eigen::Vector3d half_pull(const Spring& spring, const Eigen::Vector3d& dx) {
  const double length = std::sqrt(dx.squaredNorm());
  if (length == 0.0) return Eigen::Vector3d::Zero();
  return (0.5 * spring.stiffness * (length - spring.rest_length) / length) * dx;
}

/// The contribution of a spring to the virial of each of its two ends [J]: 1/2 T l (u u^T), tension positive; zero for
/// zero length. Exchanging the ends leaves the bits.
///
/// T is the elastic tension k (l - L) alone: stress is then a function of the positions. With damping in T, the shock
/// that a tear itself sends through its neighbours would exceed a threshold, and the sooner the smaller
/// the time step.
inline Eigen::Matrix3d spring_virial(const Spring& spring, const Eigen::Vector3d& dx) {
  const Eigen::Vector3d pull = half_pull(spring, dx);
  Eigen::Matrix3d virial;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) virial(i, j) = virial(j, i) = pull[i] * dx[j];
  return virial;
}

/// The volume at a vertex counts as at least this fraction of its volume at rest: cells that are squeezed flat, or
/// elements turned inside out, have no Cauchy stress.
inline constexpr double least_volume = 0.01;

/// The Cauchy stress at vertex k [Pa] (of a surface [N/m]): symmetric, tension positive, per present volume
/// (area)
///
///     sigma = (1 / V) * sum over the springs around it of 1/2 T l (u u^T)
///
/// or with elements, over those around it, a fourth of their volume times J times Cauchy's stress; of a surface a third
/// or a fourth of their area. Springs within the cells around it add their virial over the number of the cell's
/// vertices.
///
/// V is the present volume (area) of the vertex, its share of each cell, as eq. (1) has it at rest. The sum of V sigma
/// over all vertices is the virial of the body, and a uniform stress is the same at every vertex of a regular lattice.
/// Springs are found by walking the edges around the vertex, and summed by edge number, cells by cell number, so that
/// the bits do not depend on the order of the walk.
template <class Map>
Eigen::Matrix3d vertex_stress(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k);

/// The volumes of all vertices [m^3] (of a surface their areas), by vertex number.
struct VertexVolumes {
  std::span<const double> mass;              // [kg]
  double density = 0.0;                      // where all cells have this one, volumes at rest are masses over it
  std::span<const double> rest_of_vertex{};  // where densities differ
  std::span<const double> now{};  // of a body of springs; elements give the growth of their volumes by `virial`

  double at_rest(std::size_t k) const { return rest_of_vertex.empty() ? mass[k] / density : rest_of_vertex[k]; }
};

/// Storage for volumes of vertices that are not columns of a body, kept between calls.
struct VolumeRoom {
  std::vector<double> at_rest, now;
};

/// The corners of the cells of a body of springs, where a view has them: rows of one of the two kinds.
struct CornerRows {
  std::span<const TetrahedronNodes> tetrahedra{};
  std::span<const SolidNodes> solids{};  // of cells of any kind, polygons too
};

/// The volumes of a body's vertices, valid as long as the body and `room`; corners that are not given are walked to.
/// cost    O(cells)
template <class Map>
VertexVolumes vertex_volumes(const MassSpringBody<Map, Held::by_every_dart>& body, const CornerRows& corners,
                             VolumeRoom& room);

/// now[k] = the volume (area) at vertex k of cells of springs as they are now.
/// pre     `now` has as many numbers as there are vertices
void find_volumes_now(const Mesh& cells, std::span<const Eigen::Vector3d> position, std::span<double> now);

/// The bits of `vertex_stress` for all vertices at once, into `stress` by vertex number: one pass over the springs and
/// one over the vertices, for use in every time step.
///
/// pre     ends, springs by edge number, volumes, position by vertex number, as the body has them; the terms of its system
/// cost    O(springs + vertices); no allocation once `stress` has had its size
void vertex_stresses(std::span<const std::array<std::uint32_t, 2>> ends, SpringSpan springs,
                     const VertexVolumes& volumes, std::span<const Eigen::Vector3d> position,
                     std::vector<Eigen::Matrix3d>& stress, ForceTerms terms = {});

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

/// Where the largest eigenvalue is repeated, the direction is one of its eigenvectors, the same for the same bits.
///
/// throws  SolverError if the stress is not finite
PrincipalStress principal_stress(const Eigen::Matrix3d& stress);

/// The measures of a stress [Pa] that pictures show.
struct StressMeasures {
  double largest_principal;  // the largest eigenvalue, tension positive: as principal_stress, to the bit
  double largest_magnitude;  // of an eigenvalue
  double von_mises;          // sqrt of half the sum of the squares of the eigenvalues' differences
};
/// All are infinite where the stress is not finite.
StressMeasures measures_of(const Eigen::Matrix3d& stress);

/// An upper bound of the largest eigenvalue as it is found: Gershgorin's, plus rounding. NaN if an entry is not finite.
double principal_bound(const Eigen::Matrix3d& stress);

/// The largest principal stress [Pa] of a body's vertices: 0 without vertices, infinite where one is not finite.
double largest_principal_stress(std::span<const Eigen::Matrix3d> stresses);

#define DARTBOARD_STRESS(prefix, Map)                                                                              \
  prefix template Eigen::Matrix3d vertex_stress(const MassSpringBody<Map, Held::by_every_dart>&, std::uint32_t);   \
  prefix template VertexVolumes vertex_volumes(const MassSpringBody<Map, Held::by_every_dart>&, const CornerRows&, \
                                               VolumeRoom&);
DARTBOARD_STRESS(extern, Map2)
DARTBOARD_STRESS(extern, Map3)
DARTBOARD_STRESS(extern, TetMap)

}  // namespace dartboard
