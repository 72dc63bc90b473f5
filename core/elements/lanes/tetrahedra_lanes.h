#pragma once
// The forces of linear tetrahedra of one law, four at a time where the processor has AVX2, with the bits of one at a
// time.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/elements/lanes/law_constants.h"

namespace dartboard {

/// What a loop over tetrahedra reads and writes: columns by vertex number, nodes, shapes and masses by tetrahedron.
struct TetrahedraAt {
  const std::array<std::uint32_t, 4>* nodes;
  const Eigen::Matrix3d* shape;  // [1/m] D^-1
  const double* mass;            // [kg]
  double per_mass;               // [m^3/kg]
  const Eigen::Vector3d* x;      // [m]
  Eigen::Vector3d* force;        // [N] added to
};

/// Add the forces of the tetrahedra from `first` to before `last`. Gradients, stresses and forces are computed for four
/// at a time by the operations of one at a time in their order; then the four add to their corners one after the other.
/// So each sum has the order and the bits that it has one by one.
///
/// returns  the first tetrahedron that was not added. It has less than three behind it, or is the first of four of which
///          one needs eigenvectors for its rotation: the caller adds these four
/// pre      lanes are on
template <class Constants>
std::size_t add_forces_in_lanes(const TetrahedraAt& at, const Constants& law, std::size_t first, std::size_t last);
extern template std::size_t add_forces_in_lanes(const TetrahedraAt&, const NeoHookeanConstants&, std::size_t,
                                                std::size_t);
extern template std::size_t add_forces_in_lanes(const TetrahedraAt&, const StVenantKirchhoffConstants&, std::size_t,
                                                std::size_t);
extern template std::size_t add_forces_in_lanes(const TetrahedraAt&, const CorotationalConstants&, std::size_t,
                                                std::size_t);

/// Adds the forces of damping at velocities v [m/s] likewise: of all tetrahedra but less than four at the end.
std::size_t add_damping_in_lanes(const TetrahedraAt& at, const Eigen::Vector3d* v, const DampingConstants& material,
                                 std::size_t first, std::size_t last);

}  // namespace dartboard
