#pragma once
// Energies and momenta of a spring system.

#include <Eigen/Core>
#include <span>

#include "core/time/system/spring_system.h"

namespace dartboard {

// Sums of energies are compensated: their error is a few roundings of the result's largest term, whatever the size of
// the body.

/// Sum of the squares of all coordinates, in eight independent partial sums, uncompensated. NaN propagates.
/// cost    a sixtieth of a force evaluation
double sum_of_squares(std::span<const Eigen::Vector3d> v);

/// Sum of m v^2 / 2 [J].
double kinetic_energy(const SpringSystem& system, std::span<const Eigen::Vector3d> v);
/// Sum of k (l - L)^2 / 2 over the springs, and of the energies of the force terms [J].
double elastic_energy(const SpringSystem& system, std::span<const Eigen::Vector3d> x);
/// - sum of m g . x [J], zero at the origin.
double gravity_energy(const SpringSystem& system, std::span<const Eigen::Vector3d> x);
/// Of the pull at the vertices, - sum of m p . x [J].
double pull_energy(const SpringSystem& system, std::span<const Eigen::Vector3d> x);
/// All of them.
double total_energy(const SpringSystem& system, std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v);

/// Sum of m v [kg m/s].
Eigen::Vector3d linear_momentum(const SpringSystem& system, std::span<const Eigen::Vector3d> v);
/// Sum of m (x - centre) x v [kg m^2/s].
Eigen::Vector3d angular_momentum(const SpringSystem& system, std::span<const Eigen::Vector3d> x,
                                 std::span<const Eigen::Vector3d> v, const Eigen::Vector3d& centre = {0, 0, 0});

}  // namespace dartboard
