#pragma once
// The one interface of all time integrators: a step, its outcome, and what the steps have cost.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/archive.h"
#include "core/time/method/scheme.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Why a step, or a run, ended. Every code but `ok` is a diagnosis.
enum class StepCode : std::uint8_t {
  ok,
  unstable_step,          // UNSTABLE_DT: the energy grows as only an unstable method makes it
  not_positive_definite,  // NOT_POSDEF: a matrix that must have a Cholesky factor has none; value: the first bad pivot
  newton_stalled,         // NEWTON_STALLED: value: the residual
  zero_length,            // ZERO_LENGTH: a spring without a direction
  nonfinite,              // NONFINITE
  mass_not_positive,      // MASS_NONPOS
  step_underflow,         // DT_UNDERFLOW: value: the step
  overflow_risk,          // OVERFLOW_RISK
  coordinate_precision,   // COORD_PRECISION: rounding of the coordinates, relative to the edges
  bad_scaling,            // BAD_SCALING
  budget,                 // BUDGET: the steps or evaluations allowed are used up
};
std::string_view to_string(StepCode code);

/// The kind of element that a diagnosis names.
enum class Witness : std::uint8_t { none, vertex, edge };

/// The outcome of a step: ok, or a diagnosis that names a witness and a quantity.
struct StepResult {
  StepCode code = StepCode::ok;
  Witness witness = Witness::none;
  std::uint32_t number = 0;   // of the vertex or the edge
  std::string_view quantity;  // a literal: "velocity", "residual", ...
  double value = 0.0;

  bool ok() const { return code == StepCode::ok; }
};
/// "NONFINITE at vertex 12: velocity = nan".
std::string to_string(const StepResult& result);

/// The cost of the steps so far, in counts that are the same on every machine.
struct WorkCounters {
  std::uint64_t steps = 0;           // taken
  std::uint64_t failed_steps = 0;    // ended with a diagnosis
  std::uint64_t rejected_steps = 0;  // tried and discarded by step-size control
  std::uint64_t force_evaluations = 0;
  std::uint64_t damping_sweeps = 0;  // passes over the springs for damping alone
  std::uint64_t assemblies = 0;      // of a matrix
  std::uint64_t analyses = 0;        // symbolic
  std::uint64_t factorisations = 0;  // numeric
  std::uint64_t solves = 0;
  std::uint64_t rank_one_updates = 0;
  std::uint64_t newton_iterations = 0;
  std::uint64_t linear_iterations = 0;   // of conjugate gradients
  std::uint64_t line_search_trials = 0;  // beyond the first of each iteration
  std::uint64_t projections = 0;         // tangents made positive definite
  std::uint64_t factor_nonzeros = 0;     // of L, the latest

  template <class Archive>
  void state(Archive& archive) {
    archive(steps, failed_steps, rejected_steps, force_evaluations, damping_sweeps, assemblies, analyses,
            factorisations, solves, rank_one_updates, newton_iterations, linear_iterations, line_search_trials,
            projections, factor_nonzeros);
  }
};

/// The factor of the matrix of an implicit step, foreseen from the pattern of the matrix.
struct FactorForecast {
  std::size_t unknowns = 0;
  std::size_t numbers = 0;  // in the factor, 8 bytes each
  double seconds = 0.0;     // of one factorisation, at the rates that were measured on one thread (FactorRates)
};

/// A time integration method with the memory it needs between steps.
///
/// The system may change between steps (its columns in size or value) only if `restart` is called in between, except
/// for the values of `pull`; the motion too, for methods that are not one-step, after `motion_changed` or
/// `drives_changed`. A fixed vertex keeps its velocity whatever acts on it, so one that is given a velocity is driven.
class Integrator {
 public:
  virtual ~Integrator() = default;

  virtual const Scheme& scheme() const = 0;

  /// Advance x and v by h [s].
  ///
  /// A step that ends with a diagnosis leaves x and v as they were.
  virtual StepResult step(const SpringSystem& system, Motion motion, double h) = 0;

  /// Forget what was kept from earlier steps: the system has changed.
  virtual void restart() {}
  /// Forget what was kept of the motion and of forces: velocities have changed between two steps, or constant forces.
  /// The system has not: what is known of its matrices may stay.
  virtual void motion_changed() { restart(); }
  /// Velocities of fixed vertices have changed between two steps, and nothing else has.
  virtual void drives_changed() { motion_changed(); }

  /// Writes or reads what the bits of the next steps depend on besides the system and the motion. What the next step
  /// computes again from these, or overwrites, is left out.
  virtual void state(Archive& archive) { archive(work_); }
  /// After a step that ended by Stopped: restore all that is kept to what it was before that step, so that the step can
  /// be taken again with the same bits.
  /// returns  false where what was kept is lost
  virtual bool undo_stopped_step() { return true; }

  /// Memory that it keeps between steps, in bytes (core/base/bytes.h); 0 before the first step.
  virtual std::size_t bytes() const { return 0; }
  /// The share of `bytes` that matrices, a factor and the workspace of its solutions take.
  virtual std::size_t solver_bytes() const { return 0; }
  /// Of each factor that steps of this system will need; none where the method or its solver needs none.
  /// cost    an ordering and a symbolic analysis: a hundredth of a large factorisation
  virtual std::optional<FactorForecast> factor_forecast(const SpringSystem&) const { return std::nullopt; }

  const WorkCounters& work() const { return work_; }
  void reset_work() { work_ = {}; }

 protected:
  WorkCounters work_;
};

/// Error allowed in one step: the root mean square over all vertices of the estimated error, for positions and for
/// velocities.
struct Tolerance {
  double position;  // [m]
  double velocity;  // [m/s]
};

/// An integrator that chooses its own steps.
class AdaptiveIntegrator : public Integrator {
 public:
  /// Advance by `duration` [s], ending there exactly, in steps whose estimated error is within the tolerance.
  ///
  /// The last step size is tried first by the next call, until `restart`. x and v are those of the last step accepted
  /// when it ends with a diagnosis.
  virtual StepResult advance(const SpringSystem& system, Motion motion, double duration,
                             const Tolerance& tolerance) = 0;
};

}  // namespace dartboard
