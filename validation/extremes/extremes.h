#pragma once
// Integrators at the extremes: a matrix of scenes, integrators and values, and the outcome of each run.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time/method/integrator.h"

namespace dartboard {

/// How a run ends.
enum class ExtremeOutcome : std::uint8_t {
  ok,         // every step is its scheme's, and the end is that of the true motion
  scheme,     // every step is its scheme's; too long to resolve the motion, or there is no true motion
  survived,   // finite, energy within bounds: no witness could decide more
  degraded,   // not wrong, as far as it can be judged, with a warning before the run
  diagnosed,  // refused or stopped, with a code and a witness, the last good state kept
  silent,     // wrong, not finite or growing without bound, and not reported: forbidden
  crash       // the process ended, or hung: forbidden
};
std::string_view to_string(ExtremeOutcome outcome);

/// The evidence for an outcome.
enum class JudgedBy : std::uint8_t {
  motion,     // another code's motion, and the scheme's steps where there are witnesses for them
  scheme,     // the scheme's steps in more digits, by other code
  survival,   // neither: finite numbers, energy, warnings
  diagnosis,  // the run was refused or stopped
};
std::string_view to_string(JudgedBy by);

/// One run of the matrix.
struct ExtremeCell {
  std::string axis, scene, integrator, value;
  ExtremeOutcome outcome = ExtremeOutcome::ok;
  StepResult diagnosis;               // of a run that was refused or stopped; else the first warning
  std::uint64_t step = 0;             // the last one of the run
  std::vector<std::string> warnings;  // codes, before the run
  std::string note;                   // the reason of the outcome
  bool refused = false;               // diagnosed before the first step
  JudgedBy judged_by = JudgedBy::survival;
  double scheme_excess = 0.0;            // largest distance of a step from its scheme's, over the bound
  std::optional<double> motion_error{};  // at the end, relative to the body's displacement
  std::vector<double> end{};             // positions and velocities, of a run that was not diagnosed
  std::optional<double> offset_error{};  // in roundings of the offset, from the same run at the origin
};

/// Does the diagnosis name a quantity? The value may be NaN only if the diagnosis is that it is not finite.
bool names_a_quantity(const StepResult& diagnosis);

/// An axis of the matrix.
struct ExtremeAxis {
  std::string_view name, what;
};
std::span<const ExtremeAxis> extreme_axes();

/// The source of a run's integrator: the one of that name or, to test the judges, a wrong one.
using MakeIntegrator = std::function<std::unique_ptr<Integrator>(std::string_view name)>;
std::unique_ptr<Integrator> make_sound(std::string_view name);

/// A run that has not been made yet.
struct ExtremeCase {
  std::string axis, scene, integrator, value;
  std::function<ExtremeCell(const MakeIntegrator&)> make_run;

  ExtremeCell run(const MakeIntegrator& make = make_sound) const { return make_run(make); }
};

/// The runs of an axis; `quick` takes every third value.
///
/// throws  InputError for an unknown axis
std::vector<ExtremeCase> extreme_cases(std::string_view axis, bool quick);

}  // namespace dartboard
