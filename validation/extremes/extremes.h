#pragma once
// Integrators at the extremes: a matrix of scenes, integrators and values, and what each run of it ends with.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time/method/integrator.h"

namespace dartboard {

/// How a run ends.
enum class ExtremeOutcome : std::uint8_t {
  ok,         // the result is within its bound
  degraded,   // finite and bounded, and warned of before the run
  diagnosed,  // refused or stopped, with a code and a witness, the last good state kept
  silent,     // wrong, not finite or growing without bound, and not a word: forbidden
  crash       // the process ended, or hung: forbidden
};
std::string_view to_string(ExtremeOutcome outcome);

/// One run of the matrix.
struct ExtremeCell {
  std::string axis, scene, integrator, value;
  ExtremeOutcome outcome = ExtremeOutcome::ok;
  StepResult diagnosis;                  // of a run that was refused or stopped; else the first warning
  std::uint64_t step = 0;                // that the run ended with
  std::vector<std::string> warnings;     // codes, before the run
  std::string note;                      // why the outcome is what it is
  bool refused = false;                  // diagnosed before the first step
  std::optional<double> offset_error{};  // in roundings of the offset, from the same run at the origin
};

/// Does the diagnosis name a quantity? Only of what is diagnosed as not finite may the value be no number.
bool names_a_quantity(const StepResult& diagnosis);

/// An axis of the matrix.
struct ExtremeAxis {
  std::string_view name, what;
};
std::span<const ExtremeAxis> extreme_axes();

/// A run that has not been made yet.
struct ExtremeCase {
  std::string axis, scene, integrator, value;
  std::function<ExtremeCell()> run;
};

/// The runs of an axis; `quick` takes every third value.
///
/// throws  InputError for an axis that there is not
std::vector<ExtremeCase> extreme_cases(std::string_view axis, bool quick);

}  // namespace dartboard
