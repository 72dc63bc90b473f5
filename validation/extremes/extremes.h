#pragma once
// Integrators at the extremes: a matrix of scenes, integrators and values, and what each run of it ends with.

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
  ok,         // every step is its scheme's, and the end is where the body really goes
  scheme,     // every step is its scheme's; too long to resolve the motion, or there is no truth of that
  survived,   // finite, energy within bounds: no witness could tell more
  degraded,   // not wrong, as far as it can be judged, and warned of before the run
  diagnosed,  // refused or stopped, with a code and a witness, the last good state kept
  silent,     // wrong, not finite or growing without bound, and not a word: forbidden
  crash       // the process ended, or hung: forbidden
};
std::string_view to_string(ExtremeOutcome outcome);

/// What an outcome rests on.
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
  std::uint64_t step = 0;             // that the run ended with
  std::vector<std::string> warnings;  // codes, before the run
  std::string note;                   // why the outcome is what it is
  bool refused = false;               // diagnosed before the first step
  JudgedBy judged_by = JudgedBy::survival;
  double scheme_excess = 0.0;            // largest distance of a step from its scheme's, over the bound
  std::optional<double> motion_error{};  // at the end, over how far the body went
  std::vector<double> end{};             // positions and velocities, of a run that was not diagnosed
  std::optional<double> offset_error{};  // in roundings of the offset, from the same run at the origin
};

/// Does the diagnosis name a quantity? Only of what is diagnosed as not finite may the value be no number.
bool names_a_quantity(const StepResult& diagnosis);

/// An axis of the matrix.
struct ExtremeAxis {
  std::string_view name, what;
};
std::span<const ExtremeAxis> extreme_axes();

/// Where a run has its integrator from: a name's own, or, to see what the judges say, a wrong one.
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
/// throws  InputError for an axis that there is not
std::vector<ExtremeCase> extreme_cases(std::string_view axis, bool quick);

}  // namespace dartboard
