#pragma once
// The mechanics as the time loop sees them: contiguous columns, no map and no dart.

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/mechanics/mass_spring_body.h"
#include "core/views/spring_ends.h"

namespace dartboard {

/// What acts on a set of vertices: springs between them, ambient viscosity and gravity (the formulas:
/// core/plain/problem.h).
///
/// A view of columns that somebody else owns; valid until they change their size. Columns are by vertex or by spring
/// number.
struct SpringSystem {
  std::span<const SpringEnds> ends;
  std::span<const Spring> springs;
  std::span<const double> mass;          // [kg]
  std::span<const double> inverse_mass;  // [1/kg]
  std::span<const double> viscosity;     // [kg/s]
  std::span<const std::uint8_t> fixed;   // 1: held still
  Eigen::Vector3d gravity{0, 0, 0};      // [m/s^2]

  std::size_t vertex_count() const { return mass.size(); }
};

/// Positions [m] and velocities [m/s] by vertex number: what an integrator advances, in place.
struct Motion {
  std::span<Eigen::Vector3d> x, v;
};

}  // namespace dartboard
