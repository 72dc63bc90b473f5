#pragma once
// The stresses at the Gauss points of a cell, four points at a time where the processor has AVX2, with the bits of one
// at a time.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/elements/lanes/law_constants.h"

namespace dartboard {

/// The Gauss points of a cell of up to eight corners.
struct GaussPointsAt {
  const std::array<Eigen::Vector3d, 8>* gradients;  // of the shape functions, in reference coordinates
  const Eigen::Matrix3d* inverse;                   // [1/m] of the Jacobian
  const double* volume;                             // [m^3]
  std::size_t count, corners;
};

/// Add to the sum of each corner but the first the stress times the volume times the gradient of its function. Stresses
/// are computed at four points at a time by the operations of one at a time in their order; then the four are added one
/// after the other. `lines` are those from the first corner [m].
///
/// returns  the first point that was not added: a multiple of four. It has less than three behind it, or is the first of
///          four of which one needs eigenvectors for its rotation; the caller adds all others
/// pre      lanes are on
template <class Constants>
std::size_t add_stresses_in_lanes(const GaussPointsAt& at, const Constants& law, const Eigen::Vector3d* lines,
                                  Eigen::Vector3d* sum);
extern template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const NeoHookeanConstants&,
                                                  const Eigen::Vector3d*, Eigen::Vector3d*);
extern template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const StVenantKirchhoffConstants&,
                                                  const Eigen::Vector3d*, Eigen::Vector3d*);
extern template std::size_t add_stresses_in_lanes(const GaussPointsAt&, const CorotationalConstants&,
                                                  const Eigen::Vector3d*, Eigen::Vector3d*);

/// Adds the stresses of damping likewise, at speeds relative to the first corner [m/s].
std::size_t add_damping_in_lanes(const GaussPointsAt& at, const DampingConstants& material,
                                 const Eigen::Vector3d* lines, const Eigen::Vector3d* speeds, Eigen::Vector3d* sum);

}  // namespace dartboard
