#include "core/time/watch/preflight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/time/method/trial_state.h"
#include "core/time/system/coordinate_precision.h"

namespace dartboard {
namespace {

// Energies are sums of products of three numbers: beyond this a square is too close to the largest double.
constexpr double largest_size = 1e120;

StepResult at_vertex(StepCode code, std::size_t i, std::string_view quantity, double value) {
  return {code, Witness::vertex, static_cast<std::uint32_t>(i), quantity, value};
}
StepResult at_edge(StepCode code, std::size_t s, std::string_view quantity, double value) {
  return {code, Witness::edge, static_cast<std::uint32_t>(s), quantity, value};
}

StepResult refusal(const SpringSystem& system, Motion motion, double h) {
  if (!std::isfinite(h)) return {StepCode::nonfinite, Witness::none, 0, "step", h};
  if (!(h > 0.0)) return {StepCode::step_underflow, Witness::none, 0, "step", h};
  if (const StepResult state = check_finite(motion.x, motion.v); !state.ok()) return state;
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(system.gravity[c])) return {StepCode::nonfinite, Witness::none, 0, "gravity", system.gravity[c]};
  for (std::size_t i = 0; i < system.pull.size(); ++i)
    if (!system.pull[i].allFinite()) return at_vertex(StepCode::nonfinite, i, "force", system.pull[i].sum());
  for (std::size_t i = 0; i < system.vertex_count(); ++i) {
    if (std::isnan(system.mass[i]) || std::isinf(system.mass[i]))
      return at_vertex(StepCode::nonfinite, i, "mass", system.mass[i]);
    if (!std::isfinite(system.viscosity[i])) return at_vertex(StepCode::nonfinite, i, "viscosity", system.viscosity[i]);
    if (system.viscosity[i] < 0.0) return at_vertex(StepCode::bad_scaling, i, "viscosity", system.viscosity[i]);
    if (system.fixed[i]) continue;
    if (!(system.mass[i] > 0.0) || !std::isfinite(system.inverse_mass[i]))
      return at_vertex(StepCode::mass_not_positive, i, "mass", system.mass[i]);
  }
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const Spring& spring = system.springs[s];
    for (const auto& [quantity, value] :
         {std::pair{"stiffness", spring.stiffness}, {"rest length", spring.rest_length}, {"damping", spring.damping}}) {
      if (!std::isfinite(value)) return at_edge(StepCode::nonfinite, s, quantity, value);
      if (value < 0.0) return at_edge(StepCode::bad_scaling, s, quantity, value);
    }
  }
  for (std::size_t i = 0; i < system.vertex_count(); ++i)
    for (const auto& [quantity, size] :
         {std::pair{"position", motion.x[i].stableNorm()}, {"velocity", motion.v[i].stableNorm()}})
      if (size > largest_size) return at_vertex(StepCode::overflow_risk, i, quantity, size);
  return {};
}

bool denormal(double value) { return std::fpclassify(value) == FP_SUBNORMAL; }

void warn_of_springs(const SpringSystem& system, Motion motion, std::vector<StepResult>& warnings) {
  std::size_t zero = system.springs.size();
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const auto [i, j] = system.ends[s];
    if ((motion.x[j] - motion.x[i]).norm() == 0.0 && zero == system.springs.size()) zero = s;
  }
  if (zero < system.springs.size()) warnings.push_back(at_edge(StepCode::zero_length, zero, "length", 0.0));
  if (const auto coarse = find_coarse_coordinate(system, motion.x)) {
    const bool of_element = coarse->edge == CoordinatePrecision::of_element;
    warnings.push_back({StepCode::coordinate_precision, of_element ? Witness::vertex : Witness::edge,
                        of_element ? coarse->vertex : coarse->edge, "rounding over length", coarse->relative});
  }
}

void warn_of_denormals(const SpringSystem& system, Motion motion, std::vector<StepResult>& warnings) {
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    if (denormal(system.springs[s].stiffness)) {
      warnings.push_back(at_edge(StepCode::bad_scaling, s, "denormal stiffness", system.springs[s].stiffness));
      return;
    }
  for (std::size_t i = 0; i < system.vertex_count(); ++i) {
    if (denormal(system.mass[i])) {
      warnings.push_back(at_vertex(StepCode::bad_scaling, i, "denormal mass", system.mass[i]));
      return;
    }
    for (const double v : motion.v[i])
      if (denormal(v)) {
        warnings.push_back(at_vertex(StepCode::bad_scaling, i, "denormal velocity", v));
        return;
      }
  }
}

// A step too short for any position to change, though something moves.
void warn_of_lost_steps(const SpringSystem& system, Motion motion, double h, std::vector<StepResult>& warnings) {
  std::size_t moving = 0, lost = 0;
  for (std::size_t i = 0; i < system.vertex_count(); ++i) {
    if (motion.v[i].isZero(0.0)) continue;
    ++moving;
    // a hundred roundings of a step: a percent of it is lost
    if ((h * motion.v[i]).norm() < 100 * std::numeric_limits<double>::epsilon() * motion.x[i].norm()) ++lost;
  }
  // a vertex at the origin loses nothing, whatever the others do
  if (2 * lost > moving) warnings.push_back({StepCode::step_underflow, Witness::none, 0, "step", h});
}

}  // namespace

bool Preflight::warns_of(StepCode code) const {
  return std::ranges::any_of(warnings, [code](const StepResult& w) { return w.code == code; });
}

Preflight check_before_run(const SpringSystem& system, Motion motion, const Scheme& scheme, double h,
                           const StableStep& limits, const Horizon& horizon) {
  Preflight result;
  result.refused = refusal(system, motion, h);
  if (!result.refused.ok()) return result;
  if (!limits.is_stable(scheme, h, horizon))
    result.warnings.push_back({StepCode::unstable_step, Witness::none, 0, "step", h});
  else if (h * limits.upper > 1.0)
    result.warnings.push_back({StepCode::bad_scaling, Witness::none, 0, step_times_frequency, h * limits.upper});
  warn_of_springs(system, motion, result.warnings);
  warn_of_denormals(system, motion, result.warnings);
  // a compensated state keeps what such steps add up to
  if (!scheme.compensated) warn_of_lost_steps(system, motion, h, result.warnings);
  return result;
}

std::string explained(const StepResult& warning) {
  const bool of_step = warning.quantity == step_times_frequency;
  const char* means = "";
  switch (warning.code) {
    case StepCode::bad_scaling:
      means = of_step ? "; motions that fast are not resolved" : "; such a number has lost digits: choose other units";
      break;
    case StepCode::zero_length: means = "; a spring without length has no direction, and pulls nowhere"; break;
    case StepCode::step_underflow:
      means = "; rounding loses what positions change by: take longer steps, or a compensated integrator";
      break;
    default: break;
  }
  StepResult shown = warning;
  shown.value = std::strtod(fmt::format("{:.3g}", warning.value).c_str(), nullptr);
  return to_string(shown) + means;
}

}  // namespace dartboard
