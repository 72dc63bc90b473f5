#include "validation/extremes/extreme_judgement.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace dartboard {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

ExtremeVerdict silent(std::string note) { return {ExtremeOutcome::silent, std::move(note)}; }

}  // namespace

ExtremeVerdict verdict_of(const ExtremeObservation& run) {
  if (!run.finite) return silent("the state is not finite");
  const auto energies = [&run](const char* word) {
    return fmt::format("energy has {} from {:.3g} to {:.3g}", word, static_cast<double>(run.energy_before),
                       static_cast<double>(run.energy_after));
  };
  const double growth = run.warned_of_instability ? 1e6 : 200.0;
  if (!(run.energy_after <= growth * (run.energy_before + run.energy_rounding))) return silent(energies("grown"));
  if (run.distance_from_truth) {
    if (!(*run.distance_from_truth <= run.bound_from_truth))
      return silent(fmt::format("{:.3g} m from the true motion; the bound is {:.3g}", *run.distance_from_truth,
                                run.bound_from_truth));
  } else if (run.must_live && !run.warned_of_instability &&
             200.0L * (run.energy_after + run.energy_rounding) < run.energy_before) {
    return silent(energies("fallen"));
  }
  return {run.warned ? ExtremeOutcome::degraded : ExtremeOutcome::ok, ""};
}

ExtremeVerdict verdict_of(const EventsObservation& run) {
  const bool has_died = run.must_live && 200.0 * run.energy_after < run.energy_before;
  // at theta = 0.3 the other methods keep the energy to some percent, and dissociations keep it
  const double growth = run.explicit_euler ? std::exp(0.09 * 60) : 1.2;
  if (has_died || !run.finite || !(run.energy_after <= run.energy_before * growth + 1e-20))
    return silent(fmt::format("energy went from {:.3g} to {:.3g}", run.energy_before, run.energy_after));
  return {};
}

double truth_bound(const TruthScale& s) {
  // of order p: theta^p at once and theta^(p+1) per step, with constants below 8; explicit Euler also grows
  const double order = std::pow(s.theta * (1 + 2 * s.zeta), s.order);
  const double growth = s.explicit_euler ? std::exp(s.theta * s.theta * s.steps) : 1.0;
  return 8 * s.amplitude * order * (1 + s.steps * s.theta) * growth +
         // rounding of positions, which forces turn into velocities
         64 * epsilon * (s.size + s.amplitude * s.steps * s.theta) * (1 + s.steps * s.theta) +
         1e-9 * s.amplitude * s.steps;  // the residuals of implicit methods' equations
}

double OffsetObservation::rounding() const { return epsilon * offset; }

bool OffsetObservation::is_right() const {
  // explicit Euler amplifies rounding as everything else
  const double growth = explicit_euler ? std::exp(0.045 * static_cast<double>(steps)) : 1.0;
  // Newton's method stops within the rounding of its equations, in each step
  const double allowed = (iterates ? 1000 : 30) * rounding() * growth;
  return distance <= allowed && (warned || !(rounding() > 1e-6 * shortest));
}

bool is_unstable_by_theory(const Scheme& scheme, const StableStep& limits, double h, const Horizon& horizon) {
  return !scheme.implicit && limits.lower != 0.0 && limits.damping_time.upper == 0.0 &&
         limits.viscous_rate.upper == 0.0 &&
         h * limits.lower > 1.01 * stable_limit(scheme, 0.0, horizon.steps, horizon.gain);
}

}  // namespace dartboard
