#include "validation/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// ---- pilots

struct PilotRun {
  TimedRun run;
  double step_cost;  // in force evaluations, timed before and after
  double cpu_s;
};

struct Pilots {
  const TradeoffScene& scene;
  const CpuClock& clock;
  const RecommendOptions& options;
  ForceTimer force;
  double force_ns = infinity;  // the least so far

  PilotRun run(std::string_view contender, std::uint64_t steps, std::size_t checkpoints) {
    // a neighbour only ever makes things slower: the least times are compared
    PilotRun pilot{};
    double least_s = infinity, total_s = 0.0;
    for (int k = 0; k < 5 && (k < 2 || total_s < 0.02); ++k) {
      force_ns = std::min(force_ns, force.measure());
      const auto integrator = make_integrator(contender);
      pilot.run =
          run_timed(scene, *integrator, {.steps = steps}, clock,
                    {.checkpoints = checkpoints, .cpu_ns = static_cast<std::int64_t>(1e9 * options.most_pilot_s)});
      const double s = 1e-9 * static_cast<double>(pilot.run.cpu_ns);
      least_s = std::min(least_s, s);
      total_s += s;
      if (s > 0.1 || !pilot.run.result.ok()) break;  // long enough to be timed once
    }
    force_ns = std::min(force_ns, force.measure());
    pilot.cpu_s = least_s;
    const WorkCounters& work = pilot.run.work;
    // no step is cheaper than its force evaluations
    pilot.step_cost = std::max(1e9 * least_s / force_ns, static_cast<double>(work.force_evaluations)) /
                      static_cast<double>(std::max<std::uint64_t>(work.steps, 1));
    return pilot;
  }

  /// The farthest that a point is from where its number was at the start, in edges: what tells a motion from an
  /// explosion, also where an event has given some numbers to other points. A NaN stays one.
  double distance_from_start(const TimedRun& run) const {
    double farthest = 0.0;
    for (const PointState& state : run.states)
      for (std::size_t i = 0; i < std::min(state.x.size(), scene.motion.start.x.size()); ++i) {
        const double away = (state.x[i] - scene.motion.start.x[i]).norm() / scene.edge;
        if (!(away <= farthest)) farthest = away;
      }
    return farthest;
  }

  /// Of the states at the checkpoints reached by both, one by one.
  std::vector<double> differences(const TimedRun& a, const TimedRun& b) const {
    std::vector<double> all;
    const std::size_t count = std::min(a.states.size(), b.states.size());
    for (std::size_t c = 0; c < count; ++c) {
      const auto& network = scene.motion.network_of(scene.motion.interval_at(c));
      double sum = 0.0, mass = 0.0;
      for (std::size_t i = 0; i < network.point_count(); ++i) {
        mass += network.mass[i];
        sum += network.mass[i] * (a.states[c].x[i] - b.states[c].x[i]).squaredNorm();
      }
      all.push_back(std::sqrt(sum / mass) / scene.edge);
    }
    return all;
  }
};

/// Steps of at most h, as many between any two checkpoints: others would be split there, and not all of one size.
std::uint64_t whole_steps(const TradeoffScene& scene, double h) {
  const std::uint64_t checkpoints = scene.motion.checkpoints.size();
  return checkpoints * static_cast<std::uint64_t>(std::ceil(scene.duration / h / static_cast<double>(checkpoints)));
}

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double x : values) most = !(x <= most) ? x : most;  // a NaN wins
  return most;
}

/// The first quarter of the checkpoints, at least two; where there are events, up to the checkpoint after the first.
std::size_t prefix_of(const TradeoffScene& scene) {
  const auto& times = scene.motion.checkpoints;
  std::size_t count = std::min(times.size(), std::max<std::size_t>(2, times.size() / 4));
  if (!scene.motion.events.empty())
    while (count < times.size() && times[count - 1] <= scene.motion.events[0].time) ++count;
  return count;
}

// How the largest error so far grows with time, as a power.
double growth_of(const std::vector<double>& errors, const std::vector<double>& times) {
  if (errors.size() < 2) return 1.0;
  const std::size_t first = (errors.size() - 1) / 2, last = errors.size() - 1;
  const double early = largest(std::span(errors).first(first + 1)), late = largest(errors);
  if (!(early > 0.0) || !(late > 0.0)) return 1.0;
  return std::clamp(std::log(late / early) / std::log(times[last] / times[first]), 0.5, 2.0);
}

/// The power of h that errors are extrapolated with.
///
/// An observed order that is below the method's but near it rises towards it: the mean of both is still on the safe
/// side. Far below it, steps are too large for the fastest springs, and nothing is known about when that ends.
double slope_of(const Candidate& c) {
  const double order = c.order;
  if (c.confidence == Confidence::asymptotic || c.observed_order > order) return order;
  return c.observed_order > 0.6 * order ? 0.5 * (c.observed_order + order) : std::max(c.observed_order, 0.3);
}

// Left in the finer of two runs; by the order that was seen, which promises less than the one of the method.
double richardson(const Candidate& c, double change) {
  const double order = c.confidence == Confidence::asymptotic
                           ? c.order
                           : std::clamp(c.observed_order, 0.3, static_cast<double>(c.order));
  return change / (std::exp2(order) - 1.0);
}

/// Three pilots, or up to five where orders do not show, and the candidate's fits.
void pilot_prefix(Candidate& c, Pilots& pilots, double h, double error) {
  const TradeoffScene& scene = pilots.scene;
  const std::size_t prefix = prefix_of(scene);
  auto steps = whole_steps(scene, h);
  std::vector<PilotRun> runs;
  std::vector<std::vector<double>> change;
  for (int k = 0; k < 5; ++k, steps *= 2) {
    runs.push_back(pilots.run(c.contender, steps, prefix));
    if (!runs.back().run.result.ok()) {
      if (runs.back().run.result.code == StepCode::budget) {
        runs.pop_back();
        break;
      }
      runs.clear();  // a step too large: begin again with half of it
      change.clear();
      continue;
    }
    if (runs.size() >= 2) change.push_back(pilots.differences(runs[runs.size() - 2].run, runs.back().run));
    // the largest step that is stable is accurate enough by far: how its error falls is of no interest
    if (change.size() == 1 &&
        largest(change[0]) * 10.0 * std::pow(scene.duration / scene.motion.checkpoints[prefix - 1], 2) < error)
      break;
    if (change.size() < 2) continue;
    c.observed_order = std::log2(largest(change[change.size() - 2]) / largest(change.back()));
    if (std::abs(c.observed_order - c.order) <= 0.3) break;
    if (3.0 * runs.back().cpu_s > pilots.options.most_pilot_s) break;
  }
  const bool at_once = change.size() == 1 && std::isfinite(largest(change[0])) && runs.size() == 2;
  if (!at_once && (change.size() < 2 || !std::isfinite(c.observed_order))) {
    c.pruned = runs.empty() ? "its pilots fail" : "its pilots take too long";
    return;
  }
  if (at_once) c.observed_order = 1.0;
  const bool asymptotic = std::abs(c.observed_order - c.order) <= 0.3;
  c.confidence = at_once ? Confidence::sufficient : asymptotic ? Confidence::asymptotic : Confidence::pre_asymptotic;
  c.slope = at_once ? 1.0 : slope_of(c);
  const TimedRun& finest = runs.back().run;
  c.pilot_h = finest.h;
  // Richardson: what is left in the finer of two runs
  std::vector<double> errors = change.back();
  for (double& e : errors) e = richardson(c, e);
  const auto& times = scene.motion.checkpoints;
  const double growth = growth_of(errors, times);
  c.error_at_pilot = largest(errors) * std::pow(scene.duration / times[errors.size() - 1], growth);
  c.step_cost = runs.back().step_cost;
  if (c.implicit) {
    const PilotRun& before = runs[runs.size() - 2];
    c.step_slope = std::clamp(std::log2(before.step_cost / runs.back().step_cost), 0.0, 1.0);
  }
}

enum class FullLength : std::uint8_t { confirmed, skipped, unstable };

/// Two or three pilots over the whole duration, where they say something and do not cost too much.
///
/// Some instabilities take longer than the prefix to show: the limit of the step is lowered to what has failed then.
FullLength pilot_full_length(Candidate& c, Pilots& pilots) {
  constexpr double blown_up = 1e3;  // edges
  const TradeoffScene& scene = pilots.scene;
  const double budget = std::max(pilots.options.confirm_part * c.predicted_s, pilots.options.confirm_s);
  // three pilots with k, k/2 and k/4 times the step take 7/k of the run
  const double times_h = std::clamp(7.0 * c.predicted_s / budget, 4.0, 64.0);
  const double h = std::min(times_h * c.h, pilots.options.stability * c.limit_h);
  const auto steps = whole_steps(scene, h);
  const double expected = 3.0 * c.predicted_s * static_cast<double>(steps) / static_cast<double>(c.steps);
  if (expected > budget) return FullLength::skipped;
  const std::size_t all = scene.motion.checkpoints.size();
  const PilotRun coarse = pilots.run(c.contender, steps, all), fine = pilots.run(c.contender, 2 * steps, all);
  for (const PilotRun* pilot : {&fine, &coarse}) {
    if (pilot->run.result.code == StepCode::budget) return FullLength::skipped;
    const double away = pilots.distance_from_start(pilot->run);
    if (pilot->run.result.ok() && away < blown_up) continue;
    c.limit_h = pilot->run.h;
    return FullLength::unstable;
  }
  const double change = largest(pilots.differences(coarse.run, fine.run));
  if (!(change > 0.0)) return FullLength::skipped;
  // a third, where there is time for it, tells whether the order shows
  PilotRun finest = fine;
  double left = change;
  if (7.0 / 3.0 * expected <= 1.05 * budget) {
    PilotRun third = pilots.run(c.contender, 4 * steps, all);
    if (third.run.result.ok()) {
      left = largest(pilots.differences(fine.run, third.run));
      if (!(left > 0.0) || !std::isfinite(left)) return FullLength::skipped;
      c.observed_order = std::log2(change / left);
      const bool asymptotic = std::abs(c.observed_order - c.order) <= 0.3;
      c.confidence = asymptotic ? Confidence::asymptotic : Confidence::pre_asymptotic;
      c.slope = slope_of(c);
      finest = std::move(third);
    }
  }
  c.pilot_h = finest.run.h;
  c.error_at_pilot = richardson(c, left);
  c.step_cost = finest.step_cost;
  c.full_length = true;
  return FullLength::confirmed;
}

// Steps that a method of order p needs for a motion of that rate and size: the local error of a turn, over all turns.
double steps_of_law(const SceneFeatures& f, int order, double duration, double error) {
  const double turn = duration * f.motion_rate;
  const double constant = order == 1 ? 0.5 : order == 2 ? 1.0 / 12.0 : 1e-3;
  return turn * std::pow(std::max(constant * f.motion_size * turn / error, 1e-3), 1.0 / order);
}

void rank(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if (a.usable() != b.usable()) return a.usable();
    return a.usable() && a.predicted_cost < b.predicted_cost;
  });
}

}  // namespace

std::string_view name(Confidence confidence) {
  switch (confidence) {
    case Confidence::asymptotic: return "asymptotic";
    case Confidence::pre_asymptotic: return "pre-asymptotic";
    case Confidence::sufficient: return "sufficient";
    case Confidence::none: return "none";
  }
  return "?";
}

const Candidate* Recommendation::pick() const {
  return !candidates.empty() && candidates[0].usable() ? &candidates[0] : nullptr;
}
const Candidate* Recommendation::runner_up() const {
  return candidates.size() > 1 && candidates[1].usable() ? &candidates[1] : nullptr;
}

void solve_for_error(Candidate& c, double error, double duration, std::size_t checkpoints, double force_s,
                     const RecommendOptions& options) {
  // an order that is still rising errs on the safe side
  const double aim = c.confidence == Confidence::asymptotic || c.confidence == Confidence::sufficient ? error
                     : c.full_length                                                                  ? 0.8 * error
                                                                                                      : 0.5 * error;
  const double for_error = options.safety * c.pilot_h * std::pow(aim / c.error_at_pilot, 1.0 / c.slope);
  const double for_stability = options.stability * c.limit_h;
  const double per_interval = duration / static_cast<double>(checkpoints);
  c.limited_by_stability = for_stability < for_error;
  // whole steps between checkpoints
  const double h = std::min({for_error, for_stability, per_interval});
  c.steps = checkpoints * static_cast<std::uint64_t>(std::ceil(per_interval / h));
  c.h = duration / static_cast<double>(c.steps);
  c.predicted_error = c.error_at_pilot * std::pow(c.h / c.pilot_h, c.slope);
  c.predicted_cost = static_cast<double>(c.steps) * c.step_cost * std::pow(c.h / c.pilot_h, c.step_slope);
  c.predicted_s = c.predicted_cost * force_s;
}

Recommendation recommend(const TradeoffScene& scene, double error, const CpuClock& clock,
                         const RecommendOptions& options) {
  if (!(error > 0.0)) throw InputError("an error to meet is positive");
  const std::int64_t start = clock();
  Recommendation r;
  r.scene = scene.name;
  r.error = error;
  r.features = features_of(scene, clock);
  const std::size_t checkpoints = scene.motion.checkpoints.size();
  Pilots pilots{scene, clock, options, ForceTimer(scene, clock, 500'000)};

  double cheapest = infinity;
  const auto solve = [&](Candidate& c) {
    solve_for_error(c, error, scene.duration, checkpoints, r.features.force_s, options);
    cheapest = std::min(cheapest, c.predicted_s);
  };
  const auto begin = [&](const Scheme& scheme) {
    Candidate c;
    c.contender = scheme.name;
    c.implicit = scheme.implicit;
    c.order = scheme.order;
    c.limit_h = stability_limit(scheme, r.features, scene.duration);
    return c;
  };
  // the higher orders first: what they cost is what the others have to beat
  std::vector<Scheme> schemes;
  // a compensated method is the plain one until rounding shows, at some more cost
  for (const IntegratorEntry& entry : integrators())
    if (const Scheme& scheme = entry.make()->scheme(); !scheme.compensated) schemes.push_back(scheme);
  std::stable_sort(schemes.begin(), schemes.end(), [](const Scheme& a, const Scheme& b) {
    return a.implicit != b.implicit ? b.implicit : a.order > b.order;
  });
  for (const Scheme& scheme : schemes) {
    Candidate c = begin(scheme);
    const double needed = steps_of_law(r.features, scheme.order, scene.duration, error);
    double step_s = scheme.stages * r.features.force_s;
    if (scheme.implicit) {
      if (r.features.implicit_step_s == 0.0)
        r.features.implicit_step_s =
            implicit_step_seconds(scene, scene.duration / std::max(needed, static_cast<double>(checkpoints)), clock);
      step_s = scheme.stages * r.features.implicit_step_s;
    }
    // the law knows the motion at the start only: it has to be wrong by 4 before a method is lost to it
    if (const double law = needed * step_s; law > 4.0 * cheapest) {
      c.pruned = fmt::format("break-even law: about {:.2g} steps of {:.1e} s, {:.1e} s against {:.1e} s", needed,
                             step_s, law, cheapest);
    } else {
      double h = std::min(0.8 * c.limit_h, scene.duration / static_cast<double>(checkpoints));
      if (scheme.implicit)
        h = std::min(h, 4.0 * scene.duration / needed);
      else
        h = std::min(h, 2.5 / r.features.omega_low);
      if (!(h > 1e-4 / r.features.omega_low))
        c.pruned = "no stable step of a useful size";
      else
        pilot_prefix(c, pilots, h, error);
      if (c.usable()) solve(c);
    }
    r.candidates.push_back(std::move(c));
  }
  rank(r.candidates);
  // until the best two have been confirmed as far as that is affordable
  std::vector<std::string> tried;
  for (int round = 0; round < 12; ++round) {
    Candidate* next = nullptr;
    for (std::size_t k = 0; k < std::min<std::size_t>(2, r.candidates.size()); ++k)
      if (r.candidates[k].usable() && std::ranges::find(tried, r.candidates[k].contender) == tried.end() &&
          (k == 0 || r.candidates[k].predicted_cost < 2.0 * r.candidates[0].predicted_cost)) {
        next = &r.candidates[k];
        break;
      }
    if (next == nullptr) break;
    const FullLength outcome = pilot_full_length(*next, pilots);
    if (outcome != FullLength::unstable) tried.push_back(next->contender);
    if (outcome != FullLength::skipped) solve(*next);
    rank(r.candidates);
  }

  if (const Candidate* pick = r.pick()) {
    r.realtime_factor = scene.duration / pick->predicted_s;
    double best = infinity;
    r.realtime_error = std::numeric_limits<double>::quiet_NaN();
    for (const Candidate& candidate : r.candidates) {
      if (!candidate.usable()) continue;
      Candidate c = candidate;
      if (c.confidence == Confidence::sufficient) c.slope = c.order;  // no order was seen; the method's, then
      solve_for_error(c, error / 10.0, scene.duration, checkpoints, r.features.force_s, options);
      if (c.predicted_s < best) {
        best = c.predicted_s;
        r.one_more_digit_by = c.contender;
      }
      // seconds of the run = duration / h * step_s (h / pilot_h)^step_slope <= duration
      const double step_s = c.step_cost * r.features.force_s;
      const double h = c.step_slope < 1.0
                           ? std::pow(step_s / std::pow(c.pilot_h, c.step_slope), 1.0 / (1.0 - c.step_slope))
                           : infinity;
      if (!(h < options.stability * c.limit_h)) continue;
      const double reached = c.error_at_pilot * std::pow(h / c.pilot_h, c.slope);
      if (!(reached >= r.realtime_error)) {
        r.realtime_error = reached;
        r.realtime_by = c.contender;
      }
    }
    r.one_more_digit = best / pick->predicted_s;
  }
  r.pilot_s = 1e-9 * static_cast<double>(clock() - start);
  return r;
}

Audit audit(const TradeoffScene& scene, const SceneReference& reference, const Recommendation& recommendation,
            std::span<const WorkPoint> sweep, const CpuClock& clock) {
  const Candidate* pick = recommendation.pick();
  if (pick == nullptr) throw InputError("nothing was recommended");
  Audit a;
  a.error = recommendation.error;
  a.predicted_error = pick->predicted_error;
  a.predicted_cost = pick->predicted_cost;
  ForceTimer force(scene, clock);
  std::vector<double> costs, seconds;
  double before = force.measure(), total = 0.0;
  for (int k = 0; k < 9 && (k < 3 || total < 0.3); ++k) {
    const auto integrator = make_integrator(pick->contender);
    const TimedRun run = run_timed(scene, *integrator, {.steps = pick->steps}, clock);
    const double after = force.measure();
    costs.push_back(static_cast<double>(run.cpu_ns) / (0.5 * (before + after)));
    before = after;
    seconds.push_back(1e-9 * static_cast<double>(run.cpu_ns));
    total += seconds.back();
    a.actual_error =
        run.result.ok() ? reference::motion_errors(scene.motion, run.states, reference.states).x : infinity;
  }
  a.actual_cost = median_of(costs);
  a.actual_s = median_of(seconds);
  const double errors[]{recommendation.error};
  const Winner winner = winners(sweep, errors)[0];
  a.best = winner.contender;
  a.best_cost = winner.contender.empty() ? infinity : winner.cost;
  return a;
}

}  // namespace dartboard
