#pragma once
// The errors of a motion against its reference: in positions, velocities, energy and momenta.

#include <cstddef>
#include <span>
#include <vector>

#include "core/plain/problem.h"
#include "reference/ode_codes.h"

namespace dartboard::reference {

/// Errors without dimension. With m_i the masses at a checkpoint c, M their sum, ' the reference, all sums over points:
///
///     x = max_c sqrt( sum m_i |x_i - x'_i|^2 / M ) / L,   L the mean rest length at the start: in edges
///     v = max_c sqrt( sum m_i |v_i - v'_i|^2 ) / max_c sqrt( sum m_i |v'_i|^2 )
///     energy = max_c |H - H'| / ( max_c T' + max_c V' ),  H = T + V + G: kinetic, elastic, and that of gravity
///     momentum = max_c |P - P'| / max_c sum m_i |v'_i|
///     angular  = max_c |S - S'| / max_c sum m_i |x'_i - c'| |v'_i|,  S = sum m_i (x_i - c') x v_i, c' the centre of
///                mass of the reference at that checkpoint
///
/// Energy and momenta are compared with the reference's of the same time, not with the start's: they need not be
/// conserved. A quantity whose scale is zero is compared with zero: 0 when equal, infinite otherwise. NaN makes an
/// error of NaN.
struct MotionErrors {
  double x = 0.0, x_p95 = 0.0,
         x_largest = 0.0;  // the others: of the points' |x_i - x'_i| / L, the 95th percentile (the
                           // smallest that 95 % do not exceed) and the largest; max_c of both
  double v = 0.0;
  double energy = 0.0;
  double momentum = 0.0;
  double angular = 0.0;
};

/// The errors of the states at a motion's checkpoints.
///
/// throws  InputError unless there are as many states as checkpoints and each has the points of its network
MotionErrors motion_errors(const NetworkMotion& motion, std::span<const PointState> states,
                           std::span<const PointState> reference);

/// Kinetic, elastic and gravity energy [J] (zero at the origin), and the momenta, in extended precision.
struct NetworkSums {
  long double kinetic = 0.0L, elastic = 0.0L, gravity = 0.0L;
  Eigen::Matrix<long double, 3, 1> momentum{0, 0, 0}, angular{0, 0, 0};  // about `centre`
  long double momentum_size = 0.0L, angular_size = 0.0L;                 // sums of the absolute values
  long double energy() const { return kinetic + elastic + gravity; }
};
NetworkSums sums_of(const SpringNetwork& network, const PointState& state,
                    const Eigen::Matrix<long double, 3, 1>& centre);

Eigen::Matrix<long double, 3, 1> centre_of_mass(const SpringNetwork& network, const PointState& state);

}  // namespace dartboard::reference
