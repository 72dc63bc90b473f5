#include "validation/recommend/pilots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/plain/nan_maximum.h"

namespace dartboard {

TradeoffScene first_part(const TradeoffScene& scene, double part, std::size_t checkpoints) {
  TradeoffScene made = scene;
  made.closed_form = {};
  made.duration = part * scene.duration;
  std::erase_if(made.motion.events, [&](const auto& event) { return event.time >= made.duration; });
  made.motion.checkpoints.clear();
  for (std::size_t c = 1; c <= checkpoints; ++c)
    made.motion.checkpoints.push_back(made.duration * static_cast<double>(c) / static_cast<double>(checkpoints));
  return made;
}

Pilots::Pilots(const TradeoffScene& scene, const CpuClock& clock, const RecommendOptions& options, std::int64_t start)
    : scene_(scene),
      clock_(clock),
      options_(options),
      start_(start),
      force_(scene, clock, static_cast<std::int64_t>(1e9 * timing_s())) {}

double Pilots::timing_s() const {
  constexpr double least_s = 2e-5, most_s = 5e-4;
  return options_.budget_s > 0.0 ? std::clamp(0.0025 * options_.budget_s, least_s, most_s) : most_s;
}

double Pilots::spent_s() const { return 1e-9 * static_cast<double>(clock_() - start_); }

double Pilots::left_s() const {
  if (options_.budget_s > 0.0) return options_.budget_s - spent_s();
  if (!std::isfinite(cheapest_s_)) return options_.most_pilot_s;
  return options_.pilot_floor_s + options_.pilot_part * cheapest_s_ - spent_s();
}

PilotRun Pilots::run(const Candidate& candidate, const TradeoffScene& scene, const RunSetting& setting,
                     std::size_t checkpoints) {
  const double least_s_allowed = options_.budget_s > 0.0 ? std::min(0.01, 20.0 * timing_s()) : options_.last_look_s;
  const double limit_s = std::clamp(left_s(), least_s_allowed, std::max(options_.most_pilot_s, options_.budget_s));
  // other processes only make runs slower: the least times are compared
  PilotRun pilot;
  double least_s = std::numeric_limits<double>::infinity(), total_s = 0.0;
  for (int k = 0; k < 5 && total_s < 10.0 * timing_s(); ++k) {
    force_ns_ = std::min(force_ns_, force_.measure());
    const auto integrator = candidate.make();
    pilot.run = run_timed(scene, *integrator, setting, clock_,
                          {.checkpoints = checkpoints, .cpu_ns = static_cast<std::int64_t>(1e9 * limit_s)});
    const double s = 1e-9 * static_cast<double>(pilot.run.cpu_ns);
    least_s = std::min(least_s, s);
    total_s += s;
    if (!pilot.run.result.ok()) break;
  }
  force_ns_ = std::min(force_ns_, force_.measure());
  pilot.cpu_s = least_s;
  const WorkCounters& work = pilot.run.work;
  // no step is cheaper than its force evaluations
  pilot.step_cost = std::max(1e9 * least_s / force_ns_, static_cast<double>(work.force_evaluations)) /
                    static_cast<double>(std::max<std::uint64_t>(work.steps, 1));
  if (options_.tells) options_.tells(candidate.contender);
  return pilot;
}

double Pilots::step_seconds(const Candidate& candidate, double h) {
  constexpr double steps = 16.0;
  const TradeoffScene scene = first_part(scene_, std::min(1.0, steps * h / scene_.duration), 1);
  const auto integrator = candidate.make();
  const TimedRun run = run_timed(scene, *integrator, {.steps = whole_steps(scene, h)}, clock_);
  return 1e-9 * static_cast<double>(run.cpu_ns) / static_cast<double>(std::max<std::uint64_t>(run.work.steps, 1));
}

double Pilots::step_cost(const Candidate& candidate) {
  const double run_s = 16.0 * timing_s(),
               all_s = options_.budget_s > 0.0 ? std::clamp(0.4 * left_s(), 0.0, 0.15) : 0.15;
  // sixteen steps at least; a run that is short anyway is timed whole, including its start
  const double steps = static_cast<double>(candidate.steps);
  const double part = std::min(1.0, std::max(run_s / candidate.predicted_s, 16.0 / steps));
  std::optional<TradeoffScene> shorter;
  if (part < 1.0) shorter = first_part(scene_, part, 4);
  const TradeoffScene& scene = shorter ? *shorter : scene_;
  const RunSetting setting{.steps = part < 1.0 ? whole_steps(scene, candidate.h) : candidate.steps};
  std::vector<double> costs;
  double before = force_.measure();
  const std::int64_t start = clock_();
  for (int k = 0; k < 9 && (k < 3 || 1e-9 * static_cast<double>(clock_() - start) < all_s); ++k) {
    const auto integrator = candidate.make();
    const TimedRun run = run_timed(scene, *integrator, setting, clock_);
    const double after = force_.measure();
    if (!run.result.ok()) return candidate.step_cost;
    costs.push_back(static_cast<double>(run.cpu_ns) / (0.5 * (before + after) * static_cast<double>(run.work.steps)));
    before = after;
  }
  std::sort(costs.begin(), costs.end());
  return std::max(costs[costs.size() / 2], candidate.step_evaluations);
}

std::vector<double> differences(const TradeoffScene& scene, const TimedRun& a, const TimedRun& b) {
  std::vector<double> all;
  const std::size_t count = std::min(a.states.size(), b.states.size());
  for (std::size_t c = 0; c < count; ++c) {
    const auto& network = scene.motion.network_of(scene.motion.interval_at(c));
    double sum = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < network.point_count(); ++i) {
      mass += network.mass[i];
      sum += network.mass[i] * (a.states[c].x[i] - b.states[c].x[i]).squaredNorm();
    }
    all.push_back(mass > 0.0 ? std::sqrt(sum / mass) / scene.edge : 0.0);  // all cells may have been removed
  }
  return all;
}

double distance_from_start(const TradeoffScene& scene, const TimedRun& run) {
  double farthest = 0.0;
  for (const PointState& state : run.states)
    for (std::size_t i = 0; i < std::min(state.x.size(), scene.motion.start.x.size()); ++i)
      farthest = max_or_nan(farthest, (state.x[i] - scene.motion.start.x[i]).norm() / scene.edge);
  return farthest;
}

std::uint64_t whole_steps(const TradeoffScene& scene, double h) {
  const std::uint64_t checkpoints = scene.motion.checkpoints.size();
  return checkpoints * static_cast<std::uint64_t>(std::ceil(scene.duration / h / static_cast<double>(checkpoints)));
}

}  // namespace dartboard
