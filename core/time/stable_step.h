#pragma once
// How long a step of an explicit method may be: a bracket of the highest frequency, carried along by a running
// simulation.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/random.h"
#include "core/time/scheme.h"
#include "core/time/spring_system.h"
#include "core/time/tangent.h"

namespace dartboard {

/// A number between two bounds.
struct Bounds {
  double lower = 0.0, upper = 0.0;
};

/// How long a run is and what growth is harmless in it; see `stable_limit`.
struct Horizon {
  double steps = 1e9;
  double gain = 2.0;
};

/// What limits the step of a spring system near one state.
///
/// Stiffness is that of the springs along and across their directions at the state, compressed springs having none
/// across (Compression::projected). That matrix is at least the exact one, which a compressed spring would make
/// smaller, so the bound holds for both.
struct StableStep {
  double lower = 0.0, upper = 0.0;  // [1/s] of omega_max, at the state
  double any_state = 0.0;           // [1/s] upper bound in every state: Gershgorin's, with k in all directions
  Bounds damping_time;              // [s] c / k of the springs
  Bounds viscous_rate;              // [1/s] viscosity / mass of the free vertices, and what dampers without spring add

  /// Damping ratios at omega_max, as far as damping is that of Rayleigh: beta omega / 2 + alpha / (2 omega).
  Bounds damping_ratio() const;

  /// The longest step [s] that amplifies no oscillation of this damping ratio by `gain` within the horizon:
  /// stable_limit / upper. `Scheme::unlimited` for a method, or a system, without a limit; 0 if upper is not finite.
  double safe_step(const Scheme& scheme, double zeta, const Horizon& horizon = {}) const;

  /// Is a step of h stable for all frequencies from 0 to `upper`, each with the damping ratios that it may have? Where
  /// nothing oscillates, `upper` is 0: for what damps.
  /// Of explicit symplectic methods also undamped, since they damp spring by spring. Gaps narrower than 2e-3/h escape.
  bool is_stable(const Scheme& scheme, double h, const Horizon& horizon = {}) const;

  /// The longest step that is_stable, to 3 %.
  double safe_step(const Scheme& scheme, const Horizon& horizon = {}) const;
};

/// What Gershgorin's bound says: `upper` is `any_state`, `lower` is 0. Where a step is stable by that, there is nothing
/// to look at more closely. cost  a third of a force evaluation
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
///     omega_max <= sqrt(xi) cosh( asinh(sqrt(2 N) / failure) / (2k - 1) )    but for the probability `failure`
///
/// and k is chosen for the factor `excess`. Systems of up to 60 coordinates have their eigenvalues computed.
class StableStepEstimate {
 public:
  static constexpr double failure = 1e-9;  // probability that the upper bound is none
  static constexpr double excess = 1.06;   // upper / true, at most

  /// Bracket anew: about 40 multiplications by the stiffness, each the cost of a force evaluation.
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
  void multiply(const SpringSystem& system, std::span<const Eigen::Vector3d> in, std::span<Eigen::Vector3d> out);
  double power_iteration(const SpringSystem& system);
  double dense_largest(const SpringSystem& system);
  Bounds lanczos(const SpringSystem& system, std::size_t coordinates);

  StableStep latest_;
  std::vector<SpringTangent> tangents_;
  std::vector<double> scale_;  // 1 / sqrt(m), 0 where fixed
  std::vector<Eigen::Vector3d> scaled_, shape_, q_, previous_, w_;
  double unit_ = 0.0;  // [1/s^2] Gershgorin's bound, which the matrix is divided by
  std::size_t springs_ = 0;
  std::uint64_t multiplications_ = 0;
  SplitMix64 random_{1};
};

}  // namespace dartboard
