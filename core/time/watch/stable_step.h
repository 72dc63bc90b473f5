#pragma once
// A bracket of the highest frequency of a system, which limits its step (step_limit.h), carried along by a running
// simulation.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/random.h"
#include "core/time/method/step_limit.h"
#include "core/time/system/spring_system.h"
#include "core/time/system/tangent.h"
#include "core/time/system/term_tangents.h"

namespace dartboard {

/// The limits by Gershgorin's bound: `upper` is `any_state`, `lower` is 0, and directions are unknown. A step that is
/// stable by this bound needs no closer estimate. The bound does not cover force terms, whose stiffness grows with
/// their deformation: with them no step is stable by it.
///
/// cost  a third of a force evaluation
StableStep quick_stable_step(const SpringSystem& system);

/// An estimate that is kept from step to step.
///
/// The upper bound is a Ritz value times a factor that is proven. Let xi be the largest Ritz value of k Lanczos steps
/// on an N x N positive semidefinite matrix, from a start drawn uniformly from the cube, and lambda its largest
/// eigenvalue. xi < (1 - e) lambda needs, for every polynomial p of degree k - 1, e p(1)^2 b_1^2 <= max over [0, 1 - e]
/// of (1 - e - t) p(t)^2, with b_1 the share of the start in the eigenvector. With sqrt(1 - t/(1 - e)) p(t) a Chebyshev
/// polynomial of degree 2k - 1 that is b_1 <= 1 / sinh((2k - 1) asinh r), r^2 = e / (1 - e). A slice of a cube is at
/// most sqrt 2 times as large as a face (Ball 1986), so b_1 <= t has a probability of at most sqrt(2 N) t. Hence
///
///     omega_max <= sqrt(xi) cosh( asinh(sqrt(2 N) / failure) / (2k - 1) )    except with probability `failure`
///
/// and k is chosen for the factor `excess`. Systems of up to 60 coordinates have their eigenvalues computed. The same
/// is done for the rate of damping, whose bracket is `excess` wide itself: strong damping limits steps by that rate.
class StableStepEstimate {
 public:
  static constexpr double failure = 1e-9;            // probability that the upper bound fails
  static constexpr double excess = 1.06;             // upper / true, at most
  static constexpr double critical_excess = 1.0045;  // squared: that of the rate of damping where nearly critical

  /// Bracket anew: about 40 multiplications by the stiffness, each the cost of a force evaluation; where there is
  /// damping, as many by the damping, three times as many if it is nearly critical. Force terms are linearised once,
  /// projected, into a matrix that is then freed; damped terms three times, the last time for their stress.
  const StableStep& refresh(const SpringSystem& system, std::span<const Eigen::Vector3d> x);

  /// One power iteration on a vector that is kept, which raises the lower bound to where the highest frequency is now.
  /// Above the upper bound, or with other vertices or springs than before, everything is bracketed anew.
  const StableStep& follow(const SpringSystem& system, std::span<const Eigen::Vector3d> x);

  const StableStep& latest() const { return latest_; }
  std::uint64_t multiplications() const { return multiplications_; }

  /// The shape [dimensionless] that the power iterations have found, by vertex: sqrt(m) times the displacement.
  std::span<const Eigen::Vector3d> shape() const { return shape_; }

 private:
  bool prepare(const SpringSystem& system, std::span<const Eigen::Vector3d> x);
  struct Operator;
  void multiply(const Operator& matrix, std::span<const Eigen::Vector3d> in, std::span<Eigen::Vector3d> out);
  double power_iteration(const Operator& matrix);
  double dense_largest(const Operator& matrix);
  Bounds lanczos(const Operator& matrix, SplitMix64& random, double factor);
  Bounds largest_eigenvalue(const Operator& matrix, SplitMix64& random, double factor);
  Bounds largest_damping_rate(const SpringSystem& system, std::span<const Eigen::Vector3d> x, double factor);
  void allow_for_stress(const SpringSystem& system, std::span<const Eigen::Vector3d> x);

  StableStep latest_;
  std::vector<SpringTangent> tangents_, dampers_;
  std::vector<double> scale_;  // 1 / sqrt(m), 0 where fixed
  std::vector<Eigen::Vector3d> scaled_, shape_, q_, previous_, w_;
  double scale_frequency_ = 0.0;  // [1/s] Gershgorin's bound of the matrix here; `any_state` without force terms
  double unit_ = 0.0;             // [1/s^2] its square, which the matrix is divided by
  BlockMatrix terms_;             // the stiffness of force terms or their damping, while it is bracketed
  std::size_t springs_ = 0, pieces_ = 0;  // of force terms
  std::uint64_t multiplications_ = 0;
  SplitMix64 random_{1};
};

}  // namespace dartboard
