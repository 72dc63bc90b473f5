#include "core/time/method/integrator.h"

#include <fmt/format.h>

namespace dartboard {

std::string_view to_string(StepCode code) {
  switch (code) {
    case StepCode::ok: return "OK";
    case StepCode::unstable_step: return "UNSTABLE_DT";
    case StepCode::not_positive_definite: return "NOT_POSDEF";
    case StepCode::newton_stalled: return "NEWTON_STALLED";
    case StepCode::zero_length: return "ZERO_LENGTH";
    case StepCode::nonfinite: return "NONFINITE";
    case StepCode::mass_not_positive: return "MASS_NONPOS";
    case StepCode::step_underflow: return "DT_UNDERFLOW";
    case StepCode::overflow_risk: return "OVERFLOW_RISK";
    case StepCode::coordinate_precision: return "COORD_PRECISION";
    case StepCode::bad_scaling: return "BAD_SCALING";
    case StepCode::budget: return "BUDGET";
  }
  return "?";
}

std::string to_string(const StepResult& result) {
  std::string text(to_string(result.code));
  if (result.witness != Witness::none)
    text += fmt::format(" at {} {}", result.witness == Witness::vertex ? "vertex" : "edge", result.number);
  if (!result.quantity.empty()) text += fmt::format(": {} = {}", result.quantity, result.value);
  return text;
}

}  // namespace dartboard
