#pragma once
// Decisions that determine an outcome of the matrix of extremes, from the measurements of a run.

#include <cstdint>
#include <optional>
#include <string>

#include "core/time/watch/preflight.h"
#include "core/time/watch/stable_step.h"
#include "validation/extremes/extremes.h"

namespace dartboard {

/// A run that ended without a diagnosis.
struct ExtremeObservation {
  bool finite = true;                                        // the whole state at its end
  bool warned = false;                                       // before the run, of any problem
  bool warned_of_instability = false;                        // of an unstable step
  long double energy_before = 0.0L, energy_after = 0.0L;     // [J]
  double energy_rounding = 0.0;                              // [J] effect of rounding the positions
  bool must_live = false;                                    // nothing takes energy from the motion
  std::optional<double> distance_from_truth = std::nullopt;  // [m]; nothing without a true motion to compare with
  double bound_from_truth = 0.0;                             // [m]
};

struct ExtremeVerdict {
  ExtremeOutcome outcome = ExtremeOutcome::ok;
  std::string note;  // why it is silent
};

/// Silent if the state is not finite, if energy has grown by more than 200 (by 10^6 after a warning of an unstable
/// step: between two checks such a run may grow past the detector's bound), if it has fallen by as much and must not,
/// and beyond the bound from the true motion.
ExtremeVerdict verdict_of(const ExtremeObservation& run);

/// A run of a body that comes apart while it moves; nothing damps it.
struct EventsObservation {
  bool finite = true;
  double energy_before = 0.0, energy_after = 0.0;  // [J]
  bool explicit_euler = false;                     // which gains theta^2 a step
  bool must_live = false;                          // a method that keeps energy, and no removal that takes it away
};
/// Silent if the state is not finite, if energy has grown by a fifth (for explicit Euler, by the gain of 60 steps of
/// 0.3), or if it has fallen two hundredfold and must not.
ExtremeVerdict verdict_of(const EventsObservation& run);

/// The scales that the bound on the distance from the true motion depends on.
struct TruthScale {
  double theta = 0.0, zeta = 0.0;  // h omega_max, damping ratio there
  int order = 1;                   // of the method
  bool explicit_euler = false;     // which makes everything grow
  double steps = 0.0;
  double amplitude = 0.0, size = 0.0;  // [m] of the motion, of the coordinates
};
/// [m] Truncation of the method's order with constants below 8, rounding of positions, and the residuals of implicit
/// methods' equations.
double truth_bound(const TruthScale& scale);

/// A run at an offset, compared with the same run at the origin.
struct OffsetObservation {
  double distance = 0.0;        // [m] of the two ends, after subtracting the offset
  double offset = 0.0;          // [m]
  double shortest = 0.0;        // [m] rest length
  bool warned = false;          // of insufficient precision of the coordinates
  bool iterates = false;        // by Newton's method
  bool explicit_euler = false;  // which makes everything grow
  std::uint64_t steps = 0;

  double rounding() const;  // [m] of the offset
  /// Within 30 roundings, 1000 for methods that iterate; and with a warning if a rounding is 1e-6 of an edge.
  bool is_right() const;
};

/// Is the step longer, by a percent, than the stable one by theory for an undamped body?
bool is_unstable_by_theory(const Scheme& scheme, const StableStep& limits, double h, const Horizon& horizon);

/// Had a fault injected half way through so many steps time to be found? The detector needs 32 steps at most.
inline bool must_be_found_by(std::uint64_t steps) { return steps - steps / 2 >= 32; }

}  // namespace dartboard
