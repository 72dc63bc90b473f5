#include "validation/extreme_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "core/plain/nan_maximum.h"
#include "core/time/divergence.h"
#include "core/time/integrators.h"
#include "core/time/preflight.h"
#include "core/time/stable_step.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::chrono::milliseconds budget{400};  // of a run; a step is not interrupted

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

// The largest distance from a run of Dormand and Prince's method in eighths of the step; nothing where that fails.
std::optional<double> distance_from_finer(const ExtremeSetup& setup, const SpringColumns& start,
                                          const SpringColumns& end) {
  SpringColumns fine = start;
  const auto integrator = make_integrator("dormand-prince-54");
  for (std::uint64_t k = 0; k < 8 * setup.steps; ++k)
    if (!integrator->step(fine.system(), fine.motion(), setup.h / 8).ok()) return {};
  double distance = 0.0;
  for (std::size_t i = 0; i < fine.x.size(); ++i) distance = max_or_nan(distance, (fine.x[i] - end.x[i]).norm());
  return distance;
}

/// Has a motion that nothing damps come to rest? Of methods that keep the energy, or a quantity near it; within their
/// limit of stability that is away from it by less than what growth is allowed. Where gravity acts energy has no floor.
bool has_died(const SpringColumns& start, const Scheme& scheme, const StableStep& limits, long double before,
              long double after, double rounding) {
  const bool damped = limits.damping_time.upper > 0.0 || limits.viscous_rate.upper > 0.0;
  return conserves_energy(scheme) && !damped && start.gravity.isZero(0.0) && 200.0L * (after + rounding) < before;
}

/// The outcome of a run that ended without a diagnosis.
void judge(ExtremeCell& cell, const ExtremeSetup& setup, const SpringColumns& start, const SpringColumns& end,
           const Scheme& scheme, const StableStep& limits) {
  cell.outcome = cell.warnings.empty() ? ExtremeOutcome::ok : ExtremeOutcome::degraded;
  if (!finite(end)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "the state is not finite";
    return;
  }
  const long double before = energy_of(start), after = energy_of(end);
  double rounding = 0.0, size = largest_coordinate(start.x);
  for (const Spring& s : start.springs) rounding += s.stiffness * std::pow(64 * epsilon * (size + s.rest_length), 2);
  // between two checks an unstable step that was warned of may grow past the detector's bound
  const bool warned = std::ranges::find(cell.warnings, to_string(StepCode::unstable_step)) != cell.warnings.end();
  if (!(after <= (warned ? 1e6 : 200.0) * (before + rounding))) {
    cell.note =
        fmt::format("energy has grown from {:.3g} to {:.3g}", static_cast<double>(before), static_cast<double>(after));
    cell.outcome = ExtremeOutcome::silent;
    return;
  }
  const double theta = setup.h * limits.upper, zeta = limits.damping_ratio().upper;
  std::optional<double> distance;
  if (setup.compare && theta * (1 + 2 * zeta) <= 0.5 && cell.warnings.empty())
    distance = distance_from_finer(setup, start, end);
  if (!distance) {
    if (warned || !has_died(start, scheme, limits, before, after, rounding)) return;
    cell.outcome = ExtremeOutcome::silent;
    cell.note =
        fmt::format("energy has fallen from {:.3g} to {:.3g}", static_cast<double>(before), static_cast<double>(after));
    return;
  }
  const auto steps = static_cast<double>(setup.steps);
  double amplitude = 0.0;
  for (std::size_t i = 0; i < start.x.size(); ++i)
    amplitude = std::max(amplitude, start.v[i].norm() / std::max(limits.lower, 1e-300));
  for (std::size_t s = 0; s < start.springs.size(); ++s)
    amplitude = std::max(amplitude, std::abs((start.x[start.ends[s][1]] - start.x[start.ends[s][0]]).norm() -
                                             start.springs[s].rest_length));
  // of order p: theta^p at once and theta^(p+1) per step, with constants below 8; explicit Euler also grows
  const double order = std::pow(theta * (1 + 2 * zeta), scheme.order);
  const double growth = scheme.name == "explicit-euler" ? std::exp(theta * theta * steps) : 1.0;
  const double bound = 8 * amplitude * order * (1 + steps * theta) * growth +
                       // rounding of positions, which forces turn into velocities
                       64 * epsilon * (size + amplitude * steps * theta) * (1 + steps * theta) +
                       1e-9 * amplitude * steps;  // what implicit methods leave of their equations
  if (*distance <= bound) return;
  cell.outcome = ExtremeOutcome::silent;
  cell.note = fmt::format("{:.3g} m from a finer run; the bound is {:.3g}", *distance, bound);
}

/// How far a run at an offset is from the same run at the origin, in roundings of the offset; and whether it was warned
/// of where that is much of an edge.
void judge_offset(ExtremeCell& cell, const ExtremeSetup& setup, const SpringColumns& end) {
  SpringColumns twin = setup.body;
  twin.x = setup.at_origin;
  const auto integrator = make_integrator(cell.integrator);
  for (std::uint64_t k = 0; k < cell.step; ++k)
    if (!integrator->step(twin.system(), twin.motion(), setup.h).ok()) return;
  double distance = 0.0, shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < twin.x.size(); ++i)
    distance = max_or_nan(distance, (end.x[i] - Vector3d(setup.offset, 0, 0) - twin.x[i]).norm());
  for (const Spring& s : twin.springs) shortest = std::min(shortest, s.rest_length);
  const double rounding = epsilon * setup.offset;
  cell.offset_error = distance / rounding;
  cell.note = fmt::format("{:.3g} eps D from the run at the origin", *cell.offset_error);
  const bool warned =
      std::ranges::find(cell.warnings, to_string(StepCode::coordinate_precision)) != cell.warnings.end();
  // explicit Euler makes rounding grow as it does everything
  const double growth = cell.integrator == "explicit-euler" ? std::exp(0.045 * static_cast<double>(cell.step)) : 1.0;
  // Newton's method stops within what rounding leaves of its equations, in each step
  const double allowed = (integrator->work().newton_iterations > 0 ? 1000 : 30) * rounding * growth;
  if (!(distance <= allowed) || (rounding > 1e-6 * shortest && !warned)) cell.outcome = ExtremeOutcome::silent;
}

}  // namespace

ExtremeCell run_extreme(const ExtremeCase& which, ExtremeSetup setup) {
  ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
  SpringColumns body = setup.body;
  const auto integrator = make_integrator(which.integrator);
  const Scheme& scheme = integrator->scheme();
  StableStepEstimate estimate;
  const Horizon horizon{.steps = static_cast<double>(setup.steps), .gain = 2.0};
  const StableStep limits = estimate.refresh(body.system(), body.x);
  const Preflight preflight = check_before_run(body.system(), body.motion(), scheme, setup.h, limits, horizon);
  for (const StepResult& warning : preflight.warnings) cell.warnings.emplace_back(to_string(warning.code));
  const auto diagnosed = [&cell](const StepResult& result) {
    cell.outcome = ExtremeOutcome::diagnosed;
    cell.diagnosis = result;
  };
  if (!preflight.refused.ok()) {
    diagnosed(preflight.refused);
    cell.refused = true;
    return cell;
  }
  if (!preflight.warnings.empty()) cell.diagnosis = preflight.warnings.front();
  DivergenceDetector detector;
  StepResult result = detector.start(body.system(), body.motion(), setup.h);
  cell.refused = !result.ok();
  const auto deadline = std::chrono::steady_clock::now() + budget;
  for (; cell.step < setup.steps && result.ok(); ++cell.step) {
    if (setup.halfway && cell.step == setup.steps / 2) {
      setup.halfway(body);
      integrator->restart();
      if (setup.announced) result = detector.system_changed(body.system(), body.motion());
      if (!result.ok()) break;
    }
    result = integrator->step(body.system(), body.motion(), setup.h);
    result = result.ok() ? detector.after_step(body.system(), body.motion())
                         : detector.with_witness(result, body.system(), body.motion());
    if (result.ok() && cell.step % 16 == 15 && std::chrono::steady_clock::now() > deadline)
      result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell.step)};
  }
  if (result.ok()) result = detector.check_all(body.system(), body.motion());
  if (!result.ok()) {
    diagnosed(result);
    detector.restore(body.motion());
    if (!finite(body)) {
      cell.outcome = ExtremeOutcome::silent;
      cell.note = "the state to go back to is not finite";
    }
    return cell;
  }
  if (setup.halfway && setup.steps - setup.steps / 2 >= 32) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "what was injected was not found";
    return cell;
  }
  judge(cell, setup, setup.body, body, scheme, limits);
  if (!setup.at_origin.empty() && cell.outcome != ExtremeOutcome::silent) judge_offset(cell, setup, body);
  // a step that theory calls unstable must have been predicted
  if (cell.outcome != ExtremeOutcome::ok || scheme.implicit || limits.lower == 0.0) return cell;
  if (limits.damping_time.upper == 0.0 && limits.viscous_rate.upper == 0.0 &&
      setup.h * limits.lower > 1.01 * stable_limit(scheme, 0.0, horizon.steps, horizon.gain)) {
    cell.outcome = ExtremeOutcome::silent;
    cell.note = "an unstable step was not predicted";
  }
  return cell;
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
  return sum;
}

double highest_frequency(const SpringColumns& body) {
  StableStepEstimate estimate;
  return estimate.refresh(body.system(), body.x).lower;
}

SpringColumns moving_body(std::string_view scene, double size) {
  SpringColumns body = extreme_body(scene);
  set_moving(body, size, highest_frequency(body) / 4);
  return body;
}

ExtremeSetup with_theta(SpringColumns body, double theta, std::uint64_t steps) {
  const double omega = highest_frequency(body);
  return {.body = std::move(body), .h = omega > 0.0 ? theta / omega : 1e-3, .steps = steps};
}

}  // namespace dartboard
