#include "validation/extremes/extreme_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/plain/nan_maximum.h"
#include "core/time/integrators.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/preflight.h"
#include "core/time/watch/stable_step.h"
#include "reference/elements/elastic_point.h"
#include "reference/ode_intervals.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// Of processor time, so that a busy machine changes no verdict [s]; a step is not interrupted.
constexpr double budget = 0.4;

double largest_coordinate(const std::vector<Vector3d>& x) {
  double largest = 0.0;
  for (const Vector3d& p : x) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

bool finite(const SpringColumns& body) {
  for (std::size_t i = 0; i < body.x.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(body.x[i][c]) || !std::isfinite(body.v[i][c])) return false;
  return true;
}

bool warned_of(const ExtremeCell& cell, StepCode code) {
  return std::ranges::find(cell.warnings, to_string(code)) != cell.warnings.end();
}

/// Observes a run that ended without a diagnosis.
ExtremeObservation observe(const ExtremeCell& cell, const ExtremeSetup& setup, const SpringColumns& end,
                           const Scheme& scheme, const StableStep& limits,
                           const std::optional<MotionDistance>& motion) {
  const SpringColumns& start = setup.body;
  ExtremeObservation seen{.finite = finite(end),
                          .warned = !cell.warnings.empty(),
                          .warned_of_instability = warned_of(cell, StepCode::unstable_step)};
  if (!seen.finite) return seen;
  seen.energy_before = energy_of(start);
  seen.energy_after = energy_of(end);
  seen.must_live = keeps_moving(scheme, limits) && start.gravity.isZero(0.0);
  TruthScale scale = truth_scale(scheme, limits, setup.h, setup.steps);
  scale.size = largest_coordinate(start.x);
  for (const Spring& s : start.springs)
    seen.energy_rounding += s.stiffness * std::pow(64 * epsilon * (scale.size + s.rest_length), 2);
  if (start.solid)
    for (const reference::ElasticPoint& point : start.solid->points())
      for (const auto& gradient : point.gradient)
        seen.energy_rounding += static_cast<double>(point.volume * modulus(point.law)) *
                                std::pow(64 * epsilon * (1 + scale.size * static_cast<double>(gradient.norm())), 2);
  if (!motion || !setup.compare) return seen;
  for (std::size_t i = 0; i < start.x.size(); ++i)
    scale.amplitude = std::max(scale.amplitude, start.v[i].norm() / std::max(limits.lower, 1e-300));
  for (std::size_t s = 0; s < start.springs.size(); ++s)
    scale.amplitude = std::max(
        scale.amplitude,
        std::abs((start.x[start.ends[s][1]] - start.x[start.ends[s][0]]).norm() - start.springs[s].rest_length));
  if (start.solid)
    for (std::size_t i = 0; i < start.x.size(); ++i)
      scale.amplitude = std::max(scale.amplitude, (start.x[i] - start.solid->rest().points[i]).norm());
  compare_with_truth(seen, *motion, scale);
  return seen;
}

/// The difference of a run at an offset from the same run at the origin; nothing if that one fails.
std::optional<OffsetObservation> observe_offset(const ExtremeCell& cell, const ExtremeSetup& setup,
                                                const SpringColumns& end, const MakeIntegrator& make) {
  SpringColumns twin = setup.body;
  twin.x = setup.at_origin;
  const auto integrator = make(cell.integrator);
  for (std::uint64_t k = 0; k < cell.step; ++k)
    if (!integrator->step(twin.system(), twin.motion(), setup.h).ok()) return {};
  OffsetObservation seen{.offset = setup.offset,
                         .shortest = std::numeric_limits<double>::infinity(),
                         .warned = warned_of(cell, StepCode::coordinate_precision),
                         .iterates = integrator->work().newton_iterations > 0,
                         .explicit_euler = cell.integrator == "explicit-euler",
                         .steps = cell.step};
  for (std::size_t i = 0; i < twin.x.size(); ++i)
    seen.distance = max_or_nan(seen.distance, (end.x[i] - Vector3d(setup.offset, 0, 0) - twin.x[i]).norm());
  for (const Spring& s : twin.springs) seen.shortest = std::min(seen.shortest, s.rest_length);
  return seen;
}

void judge_offset(ExtremeCell& cell, const ExtremeSetup& setup, const SpringColumns& end, const MakeIntegrator& make) {
  const std::optional<OffsetObservation> seen = observe_offset(cell, setup, end, make);
  if (!seen) return;
  cell.offset_error = seen->distance / seen->rounding();
  cell.note = fmt::format("{:.3g} eps D from the run at the origin", *cell.offset_error);
  if (!seen->is_right()) cell.outcome = ExtremeOutcome::silent;
}

}  // namespace

ExtremeCell run_extreme(const ExtremeCase& which, ExtremeSetup setup, const MakeIntegrator& make) {
  ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
  SpringColumns body = setup.body;
  const auto integrator = make(which.integrator);
  const Scheme& scheme = integrator->scheme();
  StableStepEstimate estimate;
  const Horizon horizon{.steps = static_cast<double>(setup.steps), .gain = 2.0};
  const StableStep limits = estimate.refresh(body.system(), body.x);
  const Preflight preflight = check_before_run(body.system(), body.motion(), scheme, setup.h, limits, horizon);
  add_warnings(cell, preflight);
  if (!preflight.refused.ok()) {
    diagnose(cell, preflight.refused);
    cell.refused = true;
    return cell;
  }
  DivergenceDetector detector;
  StepResult result = detector.start(body.system(), body.motion(), setup.h);
  cell.refused = !result.ok();
  const double deadline = reference::thread_cpu_seconds() + budget;
  StepEvidence evidence(which.integrator, setup.steps, elements_of(setup.body));
  for (; cell.step < setup.steps && result.ok(); ++cell.step) {
    if (setup.halfway && cell.step == setup.steps / 2) {
      setup.halfway(body);
      integrator->restart();
      evidence.restarted();
      if (setup.announced) result = detector.system_changed(body.system(), body.motion());
      if (!result.ok()) break;
    }
    evidence.before(body.system(), body.motion(), setup.h);
    result = integrator->step(body.system(), body.motion(), setup.h);
    if (result.ok()) evidence.after(body.motion());
    result = result.ok() ? detector.after_step(body.system(), body.motion())
                         : detector.with_witness(result, body.system(), body.motion());
    if (result.ok() && cell.step % 16 == 15 && reference::thread_cpu_seconds() > deadline + evidence.seconds())
      result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell.step)};
  }
  if (result.ok()) result = detector.check_all(body.system(), body.motion());
  if (!result.ok()) {
    diagnose(cell, result);
    detector.restore(body.motion());
    if (!finite(body)) {
      cell.outcome = ExtremeOutcome::silent;
      cell.note = "the state to go back to is not finite";
    }
    return cell;
  }
  if (setup.halfway && must_be_found_by(setup.steps)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "what was injected was not found";
    return cell;
  }
  const double duration = setup.h * static_cast<double>(setup.steps);
  const auto motion = distance_from_truth(setup.body, body, duration);
  cell.end = numbers_of(body.x, body.v);
  judge_end(cell, observe(cell, setup, body, scheme, limits, motion), evidence, motion,
            is_unstable_by_theory(scheme, limits, setup.h, horizon));
  if (!setup.at_origin.empty() && cell.outcome != ExtremeOutcome::silent) judge_offset(cell, setup, body, make);
  return cell;
}

void add_warnings(ExtremeCell& cell, const Preflight& preflight) {
  for (const StepResult& warning : preflight.warnings) {
    if (cell.warnings.empty()) cell.diagnosis = warning;
    if (!warned_of(cell, warning.code)) cell.warnings.emplace_back(to_string(warning.code));
  }
}

void diagnose(ExtremeCell& cell, const StepResult& result) {
  cell.outcome = ExtremeOutcome::diagnosed;
  cell.judged_by = JudgedBy::diagnosis;
  cell.diagnosis = result;
}

TruthScale truth_scale(const Scheme& scheme, const StableStep& limits, double h, std::uint64_t steps) {
  return {.theta = h * limits.upper,
          .zeta = limits.damping_ratio().upper,
          .order = scheme.order,
          .explicit_euler = scheme.name == "explicit-euler",
          .steps = static_cast<double>(steps)};
}

void compare_with_truth(ExtremeObservation& seen, const MotionDistance& motion, const TruthScale& scale) {
  if (!(scale.theta * (1 + 2 * scale.zeta) <= 0.5) || seen.warned) return;
  seen.distance_from_truth = motion.positions;
  seen.bound_from_truth = truth_bound(scale);
}

void judge_end(ExtremeCell& cell, const ExtremeObservation& seen, const StepEvidence& evidence,
               const std::optional<MotionDistance>& motion, bool is_unstable) {
  if (motion && motion->moved > 0.0) cell.motion_error = motion->distance / motion->moved;
  const ExtremeVerdict verdict = verdict_of(seen);
  cell.outcome = verdict.outcome;
  cell.note = verdict.note;
  judge_steps(cell, evidence, motion && motion->resolved());
  const bool warned = cell.outcome == ExtremeOutcome::degraded || cell.outcome == ExtremeOutcome::silent;
  if (!warned && is_unstable) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "an unstable step was not predicted";
  }
}

// Within its limit of stability, the quantity that such a method keeps differs from the energy by less than the growth
// allowed.
bool keeps_moving(const Scheme& scheme, const StableStep& limits) {
  return conserves_energy(scheme) && !(limits.damping_time.upper > 0.0) && !(limits.viscous_rate.upper > 0.0);
}

void judge_steps(ExtremeCell& cell, const StepEvidence& evidence, bool motion_resolved) {
  cell.scheme_excess = evidence.worst();
  cell.judged_by = motion_resolved ? JudgedBy::motion : evidence.seeing() > 0 ? JudgedBy::scheme : JudgedBy::survival;
  if (cell.outcome == ExtremeOutcome::silent) return;
  if (!(evidence.worst() <= 1.0)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.judged_by = JudgedBy::scheme;
    cell.note =
        fmt::format("step {} is {:.3g} bounds from what the scheme gives", evidence.worst_step() + 1, evidence.worst());
  } else if (cell.outcome == ExtremeOutcome::ok && cell.judged_by != JudgedBy::motion) {
    cell.outcome = cell.judged_by == JudgedBy::scheme ? ExtremeOutcome::scheme : ExtremeOutcome::survived;
  }
}

std::vector<double> numbers_of(std::span<const Vector3d> x, std::span<const Vector3d> v) {
  std::vector<double> numbers;
  for (const auto& column : {x, v})
    for (const Vector3d& p : column) numbers.insert(numbers.end(), p.begin(), p.end());
  return numbers;
}

bool conserves_energy(const Scheme& scheme) { return scheme.symplectic || scheme.name == "energy-momentum"; }

long double energy_of(const SpringColumns& body) {
  long double sum = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const long double v = body.v[i][c];
      sum += 0.5L * static_cast<long double>(body.mass[i]) * v * v;
      sum -= static_cast<long double>(body.mass[i]) * body.gravity[c] * body.x[i][c];
    }
  }
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    long double square = 0;
    for (int c = 0; c < 3; ++c) {
      const long double d = static_cast<long double>(body.x[body.ends[s][1]][c]) - body.x[body.ends[s][0]][c];
      square += d * d;
    }
    const long double stretch = std::sqrt(square) - body.springs[s].rest_length;
    sum += 0.5L * static_cast<long double>(body.springs[s].stiffness) * stretch * stretch;
  }
  if (!body.solid) return sum;
  std::vector<long double> places;
  for (const Vector3d& p : body.x) places.insert(places.end(), p.begin(), p.end());
  for (const reference::ElasticPoint& point : body.solid->points())
    sum += point.volume * energy_density(point.law, deformation(point, places.data()));
  return sum;
}

double highest_frequency(const SpringColumns& body) {
  StableStepEstimate estimate;
  return estimate.refresh(body.system(), body.x).lower;
}

SpringColumns in_motion(SpringColumns body, double size) {
  set_moving(body, size, highest_frequency(body) / 4);
  return body;
}

SpringColumns moving_body(std::string_view scene, double size) { return in_motion(extreme_body(scene), size); }

ExtremeSetup with_theta(SpringColumns body, double theta, std::uint64_t steps) {
  const double omega = highest_frequency(body);
  return {.body = std::move(body), .h = omega > 0.0 ? theta / omega : 1e-3, .steps = steps};
}

}  // namespace dartboard
