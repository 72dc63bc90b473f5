#include "validation/recommend/candidate_pilots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/plain/nan_maximum.h"
#include "validation/recommend/error_growth.h"

namespace dartboard {
namespace {

// The part of the duration below which pilots predict the rest by `beyond`.
constexpr double short_part = 0.1;

/// The power of h that errors are extrapolated with.
///
/// An observed order that is below the method's but near it rises towards it: the mean of both is still on the safe
/// side. Far below it, steps are too large for the fastest springs, and nothing is known about when that ends.
double slope_of(const Candidate& c) {
  const double order = c.order;
  if (c.confidence == Confidence::asymptotic || c.observed_order > order) return order;
  return c.observed_order > 0.6 * order ? 0.5 * (c.observed_order + order) : std::max(c.observed_order, 0.3);
}

// The error left in the finer of two runs, by the observed order, which promises less than that of the method.
double richardson(const Candidate& c, double change) {
  const double order = c.confidence == Confidence::asymptotic
                           ? c.order
                           : std::clamp(c.observed_order, 0.3, static_cast<double>(c.order));
  return change / (std::exp2(order) - 1.0);
}

bool shows_its_order(const Candidate& c) { return std::abs(c.observed_order - c.order) <= 0.3; }

void take_cost(Candidate& c, const PilotRun& pilot) {
  c.step_cost = pilot.step_cost;
  c.step_evaluations = static_cast<double>(pilot.run.work.force_evaluations) /
                       static_cast<double>(std::max<std::uint64_t>(pilot.run.work.steps, 1));
}

/// Does a motion go on for ever? Damping brings a held body to rest, and leaves a free one its rotation.
bool lasts(const TradeoffScene& scene) {
  const reference::SpringNetwork& network = scene.motion.network;
  if (std::ranges::find(network.fixed, std::uint8_t{1}) == network.fixed.end()) return true;
  return !(network.viscosity > 0.0) &&
         std::ranges::none_of(network.springs, [](const reference::Spring& s) { return s.damping > 0.0; });
}

/// Set the errors of the pilots, the last of them the finest: Richardson's estimate for it, and for the coarser ones
/// their distance from it in addition; extrapolated from the part that was run to the whole.
void take_errors(Candidate& c, const TradeoffScene& scene, const std::vector<PilotRun>& runs, double part) {
  const TimedRun& finest = runs.back().run;
  std::vector<double> left = differences(scene, runs[runs.size() - 2].run, finest);
  for (double& e : left) e = richardson(c, e);
  const double growth = part < short_part ? beyond(left, 1.0 / part, lasts(scene))
                                          : std::pow(1.0 / part, growth_with_time(left, scene.motion.checkpoints));
  c.pilot_h = finest.h;
  c.error_at_pilot = growth * max_or_nan(left);
  c.coarser.clear();
  for (std::size_t k = runs.size() - 1; k-- > 0;) {
    const double error = c.error_at_pilot + growth * max_or_nan(differences(scene, runs[k].run, finest));
    const double before = c.coarser.empty() ? c.error_at_pilot : c.coarser.back().error;
    if (std::isfinite(error) && error > before) c.coarser.push_back({runs[k].run.h, error});
  }
}

/// Set what the pilots of a part of the scene show. `at_once`: the longest steps are accurate enough by far, and no
/// order is known.
void take_pilots(Candidate& c, const TradeoffScene& scene, const std::vector<PilotRun>& runs, double part,
                 bool at_once) {
  c.confidence = at_once              ? Confidence::sufficient
                 : shows_its_order(c) ? Confidence::asymptotic
                                      : Confidence::pre_asymptotic;
  c.slope = at_once ? 1.0 : slope_of(c);
  take_errors(c, scene, runs, part);
  take_cost(c, runs.back());
  if (c.implicit)
    c.step_slope = std::clamp(std::log2(runs[runs.size() - 2].step_cost / runs.back().step_cost), 0.0, 1.0);
}

/// Errors as large as the motion itself grow no more, neither with time nor with the step: they are of no use. After an
/// event that gives numbers to other points there is no size to compare with.
bool saturated(const TradeoffScene& scene, const std::vector<double>& errors, const TimedRun& run) {
  if (!scene.motion.events.empty()) return false;
  TimedRun rest;
  rest.states.assign(run.states.size(), scene.motion.start);
  return !(max_or_nan(errors) < 0.1 * max_or_nan(differences(scene, rest, run)));
}

/// [edges] How far a body may have moved that has not exploded: a thousand edges in addition to its flight.
double farthest_flight(const TradeoffScene& scene) {
  double speed = 0.0;
  for (const auto& v : scene.motion.start.v) speed = std::max(speed, v.norm());
  const double t = scene.duration;
  return 1e3 + 2.0 * t * (speed + t * scene.motion.network.gravity.norm()) / scene.edge;
}

}  // namespace

std::size_t pilot_checkpoints(const TradeoffScene& scene) {
  const auto& times = scene.motion.checkpoints;
  std::size_t count = std::min(times.size(), std::max<std::size_t>(2, times.size() / 4));
  if (!scene.motion.events.empty())
    while (count < times.size() && times[count - 1] <= scene.motion.events[0].time) ++count;
  return count;
}

double growth_with_time(const std::vector<double>& errors, const std::vector<double>& times) {
  if (errors.size() < 2) return 1.0;
  const std::size_t first = (errors.size() - 1) / 2, last = errors.size() - 1;
  const double early = max_or_nan(std::span(errors).first(first + 1)), late = max_or_nan(errors);
  if (!(early > 0.0) || !(late > 0.0)) return 1.0;
  return std::clamp(std::log(late / early) / std::log(times[last] / times[first]), 0.5, 2.0);
}

void pilot_prefix(Candidate& c, Pilots& pilots, double h, double step_s, double error) {
  // a third of the time there is, for three pilots; no run with this method takes less than with its largest steps
  const double steps_in_all = pilots.scene().duration / h;
  const RecommendOptions& options = pilots.options();
  if (options.budget_s > 0.0) step_s = std::max(step_s, pilots.step_seconds(c, h));
  const double run_s = steps_in_all * step_s;
  const double allowed_s =
      (options.budget_s > 0.0 ? pilots.left_s() - options.kept_back * options.budget_s
                              : std::min(pilots.left_s(), options.pilot_floor_s + options.pilot_part * run_s)) /
      3.0;
  std::size_t prefix = pilot_checkpoints(pilots.scene());
  const auto& all_times = pilots.scene().motion.checkpoints;
  double part = all_times[prefix - 1] / pilots.scene().duration;
  std::optional<TradeoffScene> shorter;
  if (const double expected_s = 7.0 * part * steps_in_all * step_s; expected_s > allowed_s) {
    // sixteen steps at least, and no less than a hundredth or 64 steps: growth is estimated from what is seen
    const double least = std::max(16.0 / steps_in_all, std::min(0.01, 64.0 / steps_in_all));
    part = std::min(part, std::max(part * allowed_s / expected_s, least));
    prefix = part < short_part ? 16 : 4;
    shorter = first_part(pilots.scene(), part, prefix);
  }
  const TradeoffScene& scene = shorter ? *shorter : pilots.scene();
  auto steps = whole_steps(scene, h);
  std::vector<PilotRun> runs;
  std::vector<std::vector<double>> change;
  bool at_once = false;
  for (int k = 0; k < 5; ++k, steps *= 2) {
    if (!runs.empty() && 2.0 * runs.back().cpu_s > pilots.left_s()) break;
    runs.push_back(pilots.run(c, scene, {.steps = steps}, prefix));
    if (!runs.back().run.result.ok()) {
      if (runs.back().run.result.code == StepCode::budget) {
        runs.pop_back();
        break;
      }
      runs.clear();  // a step too large: begin again with half of it
      change.clear();
      continue;
    }
    // finer runs are dearer; of an implicit method a coarser one may do
    if (const double whole_s = runs.back().cpu_s / part;
        runs.size() == 1 && whole_s > (c.implicit ? 4.0 : 1.5) * pilots.cheapest_s()) {
      c.pruned = fmt::format("with h = {:.2g} s it takes {:.1e} s in all, against {:.1e} s", runs.back().run.h, whole_s,
                             pilots.cheapest_s());
      return;
    }
    if (runs.size() >= 2) change.push_back(differences(scene, runs[runs.size() - 2].run, runs.back().run));
    // the largest step that is stable is accurate enough by far: how its error falls is of no interest
    if (change.size() == 1 && max_or_nan(change[0]) * 10.0 / (part * part) < error) {
      at_once = true;
      break;
    }
    if (change.size() < 2) continue;
    c.observed_order = std::log2(max_or_nan(change[change.size() - 2]) / max_or_nan(change.back()));
    if (shows_its_order(c)) break;
    if (3.0 * runs.back().cpu_s > allowed_s) break;
  }
  // two runs show no order: a part of the method's is used, where there is nothing else to go by
  const bool blindly = !at_once && change.size() == 1 && !std::isfinite(pilots.cheapest_s());
  if (blindly) c.observed_order = 0.7 * c.order;
  if (!at_once &&
      ((change.size() < 2 && !blindly) || !(max_or_nan(change.back()) > 0.0) || !std::isfinite(c.observed_order))) {
    c.untried = !runs.empty();
    c.pruned = runs.empty() ? "its pilots fail" : "its pilots take too long";
    return;
  }
  if (at_once) c.observed_order = 1.0;
  take_pilots(c, scene, runs, part, at_once);
  c.seen_part = part;
}

void pilot_whole(Candidate& c, Pilots& pilots, double h, double error) {
  constexpr int most_refused = 8;
  constexpr double least_order = 0.3;  // of errors that can be said to fall
  const TradeoffScene& scene = pilots.scene();
  std::vector<PilotRun> runs;
  std::vector<double> change;
  int refused = 0;
  bool at_once = false;  // the longest steps are accurate enough by far
  for (auto steps = whole_steps(scene, h);; steps *= 2) {
    if (!runs.empty() && 2.0 * runs.back().cpu_s > pilots.left_s()) break;
    PilotRun run = pilots.run(c, scene, {.steps = steps});
    if (run.run.result.code == StepCode::budget) {
      c.untried = true;
      break;
    }
    if (!run.run.result.ok() || !(distance_from_start(scene, run.run) < farthest_flight(scene))) {
      runs.clear();  // a step too large: begin again with half of it
      change.clear();
      if (++refused == most_refused) break;
      continue;
    }
    runs.push_back(std::move(run));
    if (runs.size() >= 2) change.push_back(max_or_nan(differences(scene, runs[runs.size() - 2].run, runs.back().run)));
    at_once = change.size() == 1 && 10.0 * change[0] <= error;
    // the finer run is off by less than that where the errors fall by half or better
    if (at_once || (change.size() >= 2 && change.back() <= error)) break;
    if (runs.back().cpu_s > 1.5 * pilots.cheapest_s()) {
      c.pruned = fmt::format("with h = {:.2g} s it takes {:.1e} s, against {:.1e} s", runs.back().run.h,
                             runs.back().cpu_s, pilots.cheapest_s());
      return;
    }
  }
  if ((change.size() < 2 && !at_once) || !std::isfinite(change.back())) {
    c.untried = c.untried || !runs.empty();
    c.pruned = c.untried ? "its pilots take too long" : "its pilots fail";
    return;
  }
  c.untried = false;
  c.observed_order = at_once ? 1.0 : std::log2(change.front() / change.back()) / static_cast<double>(change.size() - 1);
  if (!(c.observed_order >= least_order)) {
    c.pruned = fmt::format("its errors do not fall with the step: {:.1e} edges from h = {:.2g} s, {:.1e} from {:.2g}",
                           change.front(), runs.front().run.h, change.back(), runs[runs.size() - 2].run.h);
    return;
  }
  take_pilots(c, scene, runs, 1.0, at_once);
  c.full_length = true;
}

void pilot_tolerances(Candidate& c, Pilots& pilots, double error) {
  const TradeoffScene& scene = pilots.scene();
  double tolerance = std::clamp(10.0 * error, 1e-12, 1e-2);
  std::vector<PilotRun> runs;
  std::vector<double> change;
  for (int k = 0; k < 4; ++k, tolerance /= 10.0) {
    if (!runs.empty() && 1.6 * runs.back().cpu_s > pilots.left_s()) break;
    runs.push_back(pilots.run(c, scene, {.tolerance = tolerance}));
    if (!runs.back().run.result.ok()) {
      runs.pop_back();
      break;
    }
    c.pilot_h = tolerance;
    if (runs.size() >= 2) change.push_back(max_or_nan(differences(scene, runs[runs.size() - 2].run, runs.back().run)));
    if (change.size() < 2) continue;
    c.observed_order = std::log10(change[change.size() - 2] / change.back());
    if (std::abs(c.observed_order - 1.0) < 0.2) break;
  }
  if (change.size() < 2 || !(change.back() > 0.0) || !std::isfinite(c.observed_order)) {
    c.untried = change.size() < 2;
    c.pruned = c.untried ? "its pilots take too long" : "its pilots show no order";
    return;
  }
  c.confidence = std::abs(c.observed_order - 1.0) < 0.2 ? Confidence::asymptotic : Confidence::pre_asymptotic;
  c.slope = std::clamp(c.observed_order, 0.3, 1.1);
  c.error_at_pilot = change.back() / (std::pow(10.0, c.slope) - 1.0);
  take_cost(c, runs.back());
  double looser = c.pilot_h;
  for (std::size_t k = runs.size() - 1; k-- > 0;) {
    looser *= 10.0;
    const double seen = c.error_at_pilot + max_or_nan(differences(scene, runs[k].run, runs.back().run));
    const double before = c.coarser.empty() ? c.error_at_pilot : c.coarser.back().error;
    if (std::isfinite(seen) && seen > before)
      c.coarser.push_back({looser, seen, static_cast<double>(runs[k].run.work.steps)});
  }
  const auto steps_of = [&](std::size_t back) {
    return static_cast<double>(runs[runs.size() - 1 - back].run.work.steps);
  };
  c.pilot_steps = steps_of(0);
  // stability keeps coarse steps short; the finer they are, the nearer their number comes to its power law
  const double last = std::log10(steps_of(0) / steps_of(1)), before = std::log10(steps_of(1) / steps_of(2));
  const double power = 1.0 / c.order;
  c.steps_slope = std::clamp(std::min(last + 0.5 * std::max(last - before, 0.0), std::max(last, power)), 0.0, 0.5);
  c.full_length = true;
}

Longer pilot_far(Candidate& c, Pilots& pilots) {
  if (c.coarser.empty() || c.implicit) return Longer::skipped;
  const double h = c.coarser.back().h;
  const double whole_s = c.predicted_s * c.h / h;
  const double part = std::min(0.5, 0.5 * pilots.left_s() / (3.0 * whole_s));
  if (!(part > 1.5 * c.seen_part)) return Longer::skipped;
  const TradeoffScene scene = first_part(pilots.scene(), part, 16);
  const auto steps = whole_steps(scene, h);
  const PilotRun coarse = pilots.run(c, scene, {.steps = steps});
  const PilotRun fine = pilots.run(c, scene, {.steps = 2 * steps});
  for (const PilotRun* pilot : {&fine, &coarse}) {
    if (pilot->run.result.code == StepCode::budget) return Longer::skipped;
    if (pilot->run.result.ok() && distance_from_start(scene, pilot->run) < farthest_flight(scene)) continue;
    c.limit_h = pilot->run.h;
    return Longer::unstable;
  }
  std::vector<double> left = differences(scene, coarse.run, fine.run);
  if (!(max_or_nan(left) > 0.0) || saturated(scene, left, fine.run)) return Longer::skipped;
  for (double& e : left) e += richardson(c, e);
  const double ratio = beyond(left, 1.0 / part, lasts(scene)) * max_or_nan(left) / c.error_at(coarse.run.h);
  if (!(ratio > 0.0) || !std::isfinite(ratio)) return Longer::skipped;
  c.error_at_pilot *= ratio;
  for (Candidate::Seen& seen : c.coarser) seen.error *= ratio;
  c.seen_part = part;
  c.growth_rate = exponential_growth(left) / scene.duration;
  return Longer::confirmed;
}

Longer pilot_longer(Candidate& c, Pilots& pilots) {
  // three pilots with k, k/2 and k/4 times the step take 7/k of the run; in a short run they always see the whole, as
  // late effects are in no prefix
  const RecommendOptions& options = pilots.options();
  const double always_s = options.budget_s > 0.0 ? 0.0 : options.last_look_s;
  const double budget = std::max(0.8 * pilots.left_s(), always_s);
  if (!(budget > 0.0)) return Longer::skipped;
  const double times_h = std::clamp(7.0 * c.predicted_s / budget, 4.0, 64.0);
  const double h = std::min(times_h * c.h, options.stability * c.limit_h);
  double part = 1.0;
  if (const double expected_s = 3.0 * c.predicted_s * c.h / h; expected_s > budget) part = budget / expected_s;
  // half of the run predicts it no better than the prefix; where the prefix saw little, coarser pilots see more
  if (part < 0.5) return c.seen_part < short_part ? pilot_far(c, pilots) : Longer::skipped;
  std::optional<TradeoffScene> shorter;
  if (part < 1.0) shorter = first_part(pilots.scene(), part, pilots.scene().motion.checkpoints.size());
  const TradeoffScene& scene = shorter ? *shorter : pilots.scene();
  auto steps = whole_steps(scene, h);
  std::vector<PilotRun> runs{pilots.run(c, scene, {.steps = steps})};
  runs.push_back(pilots.run(c, scene, {.steps = steps *= 2}));
  for (const std::size_t k : {1, 0}) {
    const TimedRun& run = runs[k].run;
    if (run.result.code == StepCode::budget) return Longer::skipped;
    if (run.result.ok() && distance_from_start(scene, runs[k].run) < farthest_flight(scene)) continue;
    c.limit_h = run.h;
    return Longer::unstable;
  }
  std::vector<double> change = differences(scene, runs[0].run, runs[1].run);
  if (!(max_or_nan(change) > 0.0) || saturated(scene, change, runs[1].run)) return Longer::skipped;
  // A third pilot, where there is time for it, shows whether the order is reached. What is far off from the prefix is
  // so by late effects, which do not fall by the order of the prefix: pilots go on until an order shows.
  constexpr double far_off = 10.0;
  constexpr std::size_t most_pilots = 7;
  const bool surprises = max_or_nan(change) > far_off * c.error_at(runs[0].run.h);
  while (runs.size() < (surprises ? most_pilots : 3) &&
         2.0 * runs.back().cpu_s <= std::max(pilots.left_s(), surprises ? always_s : 0.0)) {
    PilotRun finer = pilots.run(c, scene, {.steps = steps *= 2});
    if (!finer.run.result.ok()) break;
    const std::vector<double> left = differences(scene, runs.back().run, finer.run);
    if (!(max_or_nan(left) > 0.0) || !std::isfinite(max_or_nan(left))) return Longer::skipped;
    c.observed_order = std::log2(max_or_nan(change) / max_or_nan(left));
    change = left;
    runs.push_back(std::move(finer));
    if (shows_its_order(c)) break;
  }
  if (runs.size() == 2 && surprises) c.observed_order = 0.5 * c.order;
  if (runs.size() > 2 || surprises) {
    c.confidence = shows_its_order(c) ? Confidence::asymptotic : Confidence::pre_asymptotic;
    c.slope = slope_of(c);
  }
  take_errors(c, scene, runs, part);
  take_cost(c, runs.back());
  c.full_length = part == 1.0;
  c.seen_part = part;
  return Longer::confirmed;
}

}  // namespace dartboard
