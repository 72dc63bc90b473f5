#pragma once
// The longest stable step of an explicit method, from what is known of the frequencies and the damping of a system.

#include "core/time/method/scheme.h"

namespace dartboard {

/// A number between two bounds.
struct Bounds {
  double lower = 0.0, upper = 0.0;
  template <class Archive>
  void state(Archive& archive) {
    archive(lower, upper);
  }
};

/// The length of a run and the growth that is harmless in it; see `stable_limit`.
struct Horizon {
  double steps = 1e9;  // number of steps of the run, whatever their size, unless it has a duration
  double gain = 2.0;
  double duration = 0.0;  // [s] the run has as many steps as this takes, one at least; 0: it has `steps`
};

/// The horizon of a scene of this duration [s]: a run must not amplify twofold any motion that theory says it does not
/// amplify. Without a duration the run is a single step.
Horizon horizon_of(double duration);

/// The longest stable step of a method for a system: `stable` is the limit reported to users; every step above
/// `unstable` certainly amplifies.
struct StepLimit {
  double stable = 0.0;                  // [s] the limit is not below this; longer steps are reported as too long
  double unstable = Scheme::unlimited;  // [s] the limit is not above this: longer steps amplify the fastest motion
};

/// The limits of the step of a spring system near one state.
///
/// Stiffness is that of the springs along and across their directions at the state, compressed springs having none
/// across (Compression::projected). That matrix is at least the exact one, which a compressed spring would make
/// smaller, so the bound holds for both.
///
/// Every damped oscillation x exp(s t) of M x'' + C x' + K x = 0 solves s^2 + d s + omega^2 = 0 with d = x* C x and
/// omega^2 = x* K x over x* M x: omega lies between 0 and omega_max, and d within `damping_rates(omega)`, because C is
/// the springs' stiffness along their directions times damping times, and viscosity. A step that is stable for all
/// such pairs is stable for the system, whether or not its damping is of Rayleigh's kind; Runge-Kutta methods need no
/// more, nor do methods that damp by a splitting where stiffness and damping have the same shapes. Where the shapes are
/// the same, as in a body of one material that is not stretched, d follows from omega, and the limit is found to 10 %;
/// otherwise only a lower bound is found. Methods that sweep over the dampers are treated separately: a symmetric sweep
/// takes nothing from the limit, and a sweep in one direction allows h d of 3.
struct StableStep {
  double lower = 0.0, upper = 0.0;  // [1/s] of omega_max, at the state
  double any_state = 0.0;           // [1/s] upper bound in every state: Gershgorin's, with k in all directions
  double across = 0.0;              // [1/s] upper bound of omega_max by the stiffness of springs across, and by that of
                                    // damped elements that stress adds to their stiffness at rest
  Bounds damping_time{};            // [s] c / k of the springs, and that of elements
  Bounds viscous_rate{};  // [1/s] viscosity / mass of the free vertices; above, dampers without spring and stress
  Bounds damping_rate{0.0, Scheme::unlimited};  // [1/s] of the largest d, all damping together

  /// Damping ratios at omega_max, as far as damping is that of Rayleigh: beta omega / 2 + alpha / (2 omega).
  Bounds damping_ratio() const;

  /// The limits that the system would have without its damping.
  StableStep undamped() const;

  /// [1/s] `upper`, or less where a known rate of damping implies it: d is beta (omega^2 - across^2) at least.
  double highest_omega() const;

  /// [1/s] Bounds of d for the oscillations of one omega.
  Bounds damping_rates(double omega) const;

  /// The longest stable step; nothing else decides it. A method that is not explicit, or a system that does not limit
  /// the step, has no limit; `stable` is 0 if upper is not finite.
  ///
  /// cost  about a millisecond, and some more for each frequency whose damping makes it limit the step
  StepLimit limit(const Scheme& scheme, const Horizon& horizon = {}) const;

  /// limit().stable
  double safe_step(const Scheme& scheme, const Horizon& horizon = {}) const;

  /// Is h at most limit().stable? The answer is quick where h is far below it.
  bool is_stable(const Scheme& scheme, double h, const Horizon& horizon = {}) const;

  /// The longest step [s] that amplifies no oscillation of this damping ratio by `gain` within the horizon:
  /// stable_limit / upper. `Scheme::unlimited` for a method, or a system, without a limit; 0 if upper is not finite.
  double safe_step(const Scheme& scheme, double zeta, const Horizon& horizon = {}) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(lower, upper, any_state, across, damping_time, viscous_rate, damping_rate);
  }

 private:
  double stable_step(const Scheme& scheme, const Horizon& horizon) const;
  double unstable_step(const Scheme& scheme, const Horizon& horizon) const;
};

}  // namespace dartboard
