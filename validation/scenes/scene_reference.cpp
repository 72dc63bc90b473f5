#include "validation/scenes/scene_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/time/explicit/blanes_moan_4.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "reference/error_norms.h"
#include "reference/ode_oracle.h"

namespace dartboard {
namespace {

// The time of the right-hand side in extended precision per spring and per Gauss point, and its evaluations in a step
// of the oracle.
constexpr double oracle_spring_ns = 45.0, oracle_point_ns = 1500.0, oracle_stages = 13.0;

TimedRun must_run(const TradeoffScene& scene, Integrator&& integrator, std::uint64_t steps, const CpuClock& clock) {
  TimedRun run = run_timed(scene, integrator, {.steps = steps}, clock);
  if (!run.result.ok())
    throw SolverError(fmt::format("no reference: {} with {} steps ends with {}", integrator.scheme().name, steps,
                                  to_string(run.result)));
  return run;
}

SceneReference self_converged(const TradeoffScene& scene, const CpuClock& clock, double most_s) {
  SceneReference found;
  found.kind = ReferenceKind::self_converged;
  const auto difference = [&](const TimedRun& a, const TimedRun& b) {
    return reference::motion_errors(scene.motion, a.states, b.states).x;
  };
  // from h omega_max of about 1 on
  std::uint64_t steps = scene.motion.checkpoints.size();
  while (scene.fastest_rate * scene.duration / static_cast<double>(steps) > 1.0) steps *= 2;
  TimedRun coarse = must_run(scene, BlanesMoan4(), steps, clock);
  double change = 0.0, change_before = 0.0;
  for (;;) {
    steps *= 2;
    TimedRun fine = must_run(scene, BlanesMoan4(), steps, clock);
    change_before = std::exchange(change, difference(coarse, fine));
    found.cpu_s += 1e-9 * static_cast<double>(coarse.cpu_ns);
    coarse = std::move(fine);
    if (change < 1e-12 || 2e-9 * static_cast<double>(coarse.cpu_ns) > most_s) break;
  }
  found.cpu_s += 1e-9 * static_cast<double>(coarse.cpu_ns);
  // the kinks of contact, and means of loads, lower every order: at order p, the finer run is off by 1 / (2^p - 1) of
  // the change
  const double order = scene.equal_steps().empty() ? 4.0 : std::clamp(std::log2(change_before / change), 0.5, 4.0);
  const double left = 15.0 / (std::exp2(order) - 1.0) * change;
  const double own = self_converged_floor(left, 0.0);
  std::uint64_t other_steps = steps;
  for (double before = std::numeric_limits<double>::infinity();; other_steps *= 2) {
    const TimedRun other = must_run(scene, DormandPrince54(), other_steps, clock);
    found.agreement = difference(other, coarse);
    found.cpu_s += 1e-9 * static_cast<double>(other.cpu_ns);
    // rounding ends its convergence
    if (found.agreement <= own || !(found.agreement < 0.5 * before)) break;
    if (2e-9 * static_cast<double>(other.cpu_ns) > most_s) break;
    before = found.agreement;
  }
  found.states = std::move(coarse.states);
  found.floor = self_converged_floor(left, found.agreement);
  found.what = fmt::format(
      "self-converged: blanes-moan-4 with {} steps, {:.1e} edges from half as many; dormand-prince-54 with {} is {:.1e} "
      "edges away{}",
      steps, change, other_steps, found.agreement,
      found.agreement <= own ? "" : ", and leaves errors below that unconfirmed");
  return found;
}

}  // namespace

std::string_view name(ReferenceKind kind) {
  switch (kind) {
    case ReferenceKind::closed_form: return "closed form";
    case ReferenceKind::certified: return "certified";
    case ReferenceKind::self_converged: return "self-converged";
    case ReferenceKind::other_codes: return "other codes";
  }
  return "?";
}

double self_converged_floor(double change, double agreement) {
  // order 4: the finer run is off by a fifteenth of the change; ten times that is the floor
  return max_or_nan(max_or_nan(10.0 / 15.0 * change, 1e-12), agreement);
}

std::string certainty_of(const reference::CertifiedMotion& certified) {
  if (certified.accepted && certified.independent) return "certified by two independent codes";
  // the bound that the oracle uses
  constexpr double accepted = reference::CertifyOptions{}.accepted;
  if (certified.self_difference <= accepted && certified.agreement <= accepted)
    return fmt::format("confirmed by another method of the same library, by no independent code to {:.0e}", accepted);
  return "NOT certified: the codes do not agree";
}

SceneReference reference_of(const TradeoffScene& scene, const CpuClock& clock, const ReferenceOptions& options) {
  if (scene.closed_form) {
    // the sums of the closed form are rounded to the coordinates, whose size is some tens of edges
    return {.kind = ReferenceKind::closed_form,
            .states = scene.closed_form(),
            .floor = 1e-13,
            .gain = 1.0,
            .cpu_s = 0.0,
            .what = "closed form"};
  }
  if (!scene.beyond_references.empty()) {
    SceneReference found = self_converged(scene, clock, options.self_converged_s);
    found.what += fmt::format(" (the oracle does not support {})", scene.beyond_references);
    return found;
  }
  const reference::SpringNetwork& network = scene.motion.network;
  const double evaluation_ns = oracle_spring_ns * static_cast<double>(network.springs.size()) +
                               oracle_point_ns * static_cast<double>(network.elements.size());
  const double phase = options.low_floor ? 0.1 : 0.25;  // h omega_max of the coarser of two runs
  const double expected_s = 1e-9 * scene.fastest_rate * scene.duration / phase * oracle_stages * evaluation_ns;
  if (expected_s > options.oracle_s) {
    SceneReference found = self_converged(scene, clock, options.self_converged_s);
    found.what += fmt::format(" (one run of the oracle would take about {:.0f} s)", expected_s);
    return found;
  }
  const std::int64_t start = clock();
  reference::CertifiedMotion certified = reference::certify(
      scene.motion,
      {.step_times_rate = phase, .extrapolation = true, .all_codes = options.low_floor, .gain = options.gain});
  SceneReference found;
  found.kind = ReferenceKind::certified;
  found.gain = certified.largest_gain();
  found.floor = certified.floor;
  found.cpu_s = 1e-9 * static_cast<double>(clock() - start);
  found.agreement = certified.agreement;
  found.what = fmt::format("{}: self-difference {:.1e}, another code {:.1e} edges away", certainty_of(certified),
                           certified.self_difference, certified.agreement);
  found.states = std::move(certified.states);
  return found;
}

}  // namespace dartboard
