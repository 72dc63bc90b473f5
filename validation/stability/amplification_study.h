#pragma once
// Effect of one step on an undamped oscillation, its amplitude and its phase, as computed by integrators and by
// theory.

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "core/time/integrators.h"

namespace dartboard {

/// One integrator at one step.
struct AmplificationPoint {
  std::string integrator;
  bool implicit = false;
  double theta = 0.0;                     // h omega
  std::complex<double> measured, theory;  // the factor of the oscillation in a step
  double tolerance = 0.0;                 // of their difference, relative, from the rounding of positions

  double deviation() const { return std::abs(measured - theory) / std::abs(theory); }
  bool holds() const { return deviation() <= tolerance; }

  double amplitude() const { return std::abs(measured); }
  double phase() const;  // [rad] in [0, 2 pi); of the motion: theta
  double theoretical_phase() const;
  /// The damping ratio of the oscillator whose solution decays and turns by as much: - ln |R| / phase.
  double damping_ratio() const;
  double theoretical_damping_ratio() const;
};

/// The closed form of a method (reference/closed_form.h), never the integrator's own statement.
///
/// throws  InputError for an integrator without one
std::complex<double> theoretical_amplification(const Scheme& scheme, double theta);

/// Runs on a mass on a spring at a wall, colinear and hence exactly linear: a step from two independent states gives
/// the matrix of the step, and its eigenvalue is the measurement; for BDF2 three steps give its recurrence. Implicit
/// methods at all `thetas`, explicit ones where they are stable.
std::vector<AmplificationPoint> measure_amplification(std::span<const double> thetas,
                                                      std::span<const IntegratorEntry> entries = integrators());

/// From 1e-2 to 1e3, so many per decade.
std::vector<double> amplification_steps(int per_decade);

}  // namespace dartboard
