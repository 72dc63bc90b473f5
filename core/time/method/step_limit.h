#pragma once
// How long a step of an explicit method may be, from what is known of the frequencies and the damping of a system.

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

/// How long a run is and what growth is harmless in it; see `stable_limit`.
struct Horizon {
  double steps = 1e9;  // of the run, whatever their size, unless it has a duration
  double gain = 2.0;
  double duration = 0.0;  // [s] and as many steps as it takes, one at least; 0: `steps`
};

/// Of a scene that lasts so long [s]: a run must not amplify anything twofold that theory says it does not. Without a
/// duration it is a single step.
Horizon horizon_of(double duration);

/// The longest stable step of a method for a system, as the one number that everybody is told, and what is certain
/// above it.
struct StepLimit {
  double stable = 0.0;                  // [s] the limit is not below this: longer steps are called too long
  double unstable = Scheme::unlimited;  // [s] nor above this: what is a little longer amplifies the fastest motion
};

/// What limits the step of a spring system near one state.
///
/// Stiffness is that of the springs along and across their directions at the state, compressed springs having none
/// across (Compression::projected). That matrix is at least the exact one, which a compressed spring would make
/// smaller, so the bound holds for both.
///
/// Every damped oscillation x exp(s t) of M x'' + C x' + K x = 0 solves s^2 + d s + omega^2 = 0 with d = x* C x and
/// omega^2 = x* K x over x* M x: omega lies between 0 and omega_max, and d within `damping_rates(omega)`, because C is
/// what the springs have along their directions times their damping times, and viscosity. A step that is stable for all
/// such pairs is stable for the system, whether or not its damping is of Rayleigh's kind; Runge-Kutta methods need no
/// more, and methods that damp by a splitting are the same where stiffness and damping have the same shapes. Where they
/// have, as in a body of one material that is not stretched, d follows from omega, and the limit is found to 10 %; else
/// only that it is not below. Methods that sweep over the dampers are a matter of their own: a symmetric sweep takes
/// nothing from the limit, and one in one direction allows h d of 3.
struct StableStep {
  double lower = 0.0, upper = 0.0;  // [1/s] of omega_max, at the state
  double any_state = 0.0;           // [1/s] upper bound in every state: Gershgorin's, with k in all directions
  double across = 0.0;              // [1/s] upper bound of omega_max by what springs have across, and stressed elements
                                    // beside what they have without stress, where they are damped
  Bounds damping_time{};            // [s] c / k of the springs, and that of elements
  Bounds viscous_rate{};  // [1/s] viscosity / mass of the free vertices; above, dampers without spring and stress
  Bounds damping_rate{0.0, Scheme::unlimited};  // [1/s] of the largest d, all damping together

  /// Damping ratios at omega_max, as far as damping is that of Rayleigh: beta omega / 2 + alpha / (2 omega).
  Bounds damping_ratio() const;

  /// [1/s] `upper`, or less where a rate of damping that is known says so: d is beta (omega^2 - across^2) at least.
  double highest_omega() const;

  /// [1/s] d of the oscillations of one omega.
  Bounds damping_rates(double omega) const;

  /// The longest stable step: the one place where that is decided. Without an explicit method, or a system that limits
  /// it, there is no limit; `stable` is 0 if upper is not finite.
  ///
  /// cost  about a millisecond, and some for each frequency whose damping makes it the one that limits the step
  StepLimit limit(const Scheme& scheme, const Horizon& horizon = {}) const;

  /// limit().stable
  double safe_step(const Scheme& scheme, const Horizon& horizon = {}) const;

  /// Is h at most limit().stable? Quickly where h is far below it.
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
