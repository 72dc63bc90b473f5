#include "validation/stability/detection_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/time/integrators.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/preflight.h"
#include "validation/extremes/extreme_run.h"
#include "validation/stability/frequency_oracle.h"

namespace dartboard {
namespace {

constexpr std::uint64_t most_steps = 5000;

SpringColumns body_in_fastest_mode(std::string_view name, const FastestMode& mode) {
  SpringColumns body = extreme_body(name);
  for (std::size_t i = 0; i < body.x.size(); ++i)
    if (!body.fixed[i]) body.x[i] += 0.01 * mode.shape[i];
  return body;
}

const Horizon horizon{.steps = static_cast<double>(most_steps), .gain = 2.0};

// h omega; nothing where the method is stable there, in a gap above its first limit.
std::optional<double> unstable_theta(const Scheme& scheme, double factor) {
  const double theta = factor * stable_limit(scheme, 0.0, horizon.steps, horizon.gain);
  if (std::log(spectral_radius(scheme, theta, 0.0)) * horizon.steps < std::log(horizon.gain)) return {};
  return theta;
}

}  // namespace

Detection watch_for_divergence(const IntegratorEntry& entry, SpringColumns body, double h, double factor) {
  Detection found;
  found.integrator = entry.name;
  found.factor = factor;
  const auto integrator = entry.make();
  const Scheme& scheme = integrator->scheme();
  StableStepEstimate estimate;
  const StableStep limits = estimate.refresh(body.system(), body.x);
  found.predicted =
      check_before_run(body.system(), body.motion(), scheme, h, limits, horizon).warns_of(StepCode::unstable_step);
  DivergenceDetector detector;
  StepResult result = detector.start(body.system(), body.motion(), h);
  const long double bound = DivergenceDetector::gain * energy_of(body);
  std::uint64_t above = 0;
  while (result.ok() && found.steps < most_steps) {
    result = integrator->step(body.system(), body.motion(), h);
    ++found.steps;
    // a step that ends with a diagnosis leaves the motion as it was
    if (energy_of(body) <= bound) {
      above = 0;
    } else {
      found.above = std::max(found.above, ++above);
      if (!found.passed) found.passed = found.steps;
    }
    if (result.ok()) result = detector.after_step(body.system(), body.motion());
  }
  if (!result.ok()) found.detected = found.steps;
  return found;
}

std::vector<double> detection_factors(bool quick) {
  if (quick) return {1.001, 1.01, 1.1, 2, 1e4};
  return {1.0001, 1.001, 1.003, 1.01, 1.03, 1.1, 1.2, 1.5, 2, 5, 10, 1e2, 1e4, 1e8};
}

std::vector<Detection> measure_detection(bool quick) {
  std::vector<Detection> all;
  for (const std::string_view name : extreme_bodies) {
    const FastestMode mode = fastest_mode(extreme_body(name));
    for (const bool mixed : {true, false}) {
      const SpringColumns body = mixed ? moving_body(name) : body_in_fastest_mode(name, mode);
      const double omega = fastest_mode(body).omega;
      for (const IntegratorEntry& entry : integrators()) {
        const Scheme& scheme = entry.make()->scheme();
        if (scheme.implicit || scheme.imaginary_limit == 0.0) continue;
        for (const double factor : detection_factors(quick)) {
          const std::optional<double> theta = unstable_theta(scheme, factor);
          if (!theta) continue;
          Detection found = watch_for_divergence(entry, body, *theta / omega, factor);
          found.body = std::string(name) + (mixed ? "" : ", fastest mode");
          all.push_back(std::move(found));
        }
      }
    }
  }
  return all;
}

}  // namespace dartboard
