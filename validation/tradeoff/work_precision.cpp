#include "validation/tradeoff/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/median.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "core/time/integrators.h"
#include "validation/tradeoff/cvode_adams.h"

namespace dartboard {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void add_solvers(std::vector<TradeoffContender>& contenders, std::string_view name) {
  for (const std::string_view solver : {"fresh-factor", "conjugate-gradients"})
    contenders.push_back(
        {fmt::format("{}-{}", name, solver), [name, solver] { return make_integrator(name, solver); }, false, false});
}

bool is_useful(const WorkPoint& p) { return p.standing != Standing::failed && p.standing != Standing::useless; }

class Study {
 public:
  Study(const TradeoffScene& scene, const SceneReference& reference, const CpuClock& clock,
        const WorkPrecisionOptions& options)
      : scene_(scene), reference_(reference), clock_(clock), options_(options), force_(scene, clock) {}

  WorkPoint measure(const TradeoffContender& contender, const RunSetting& setting) {
    WorkPoint point;
    point.contender = contender.name;
    point.peer = contender.peer;
    point.setting = setting;
    std::vector<double> cpu, force;
    double before = force_.measure(), total = 0.0;
    for (int k = 0; k < options_.most_repetitions; ++k) {
      if (k >= options_.fewest_repetitions && total > options_.repetitions_s) break;
      const auto integrator = contender.make();
      const TimedRun run = run_timed(scene_, *integrator, setting, clock_,
                                     {.cpu_ns = static_cast<std::int64_t>(1.5e9 * options_.most_s)});
      const double after = force_.measure();
      force.push_back(0.5 * (before + after));
      before = after;
      cpu.push_back(static_cast<double>(run.cpu_ns));
      point.costs.push_back(cpu.back() / force.back());
      total += 1e-9 * cpu.back();
      if (k == 0) {
        point.h = run.h;
        point.h_omega = run.h * scene_.fastest_rate;
        point.work = run.work;
        if (!run.result.ok()) {
          point.code = to_string(run.result.code);
          point.diagnosis = to_string(run.result);
          break;  // the cost of a failed run need not be precise
        }
        point.errors = reference::motion_errors(scene_.motion, run.states, reference_.states);
      }
    }
    point.cost = median_of(point.costs);
    point.cpu_s = 1e-9 * median_of(cpu);
    point.force_s = 1e-9 * median_of(force);
    point.under_floor = !point.failed() && point.errors.x < reference_.floor;
    return point;
  }

 private:
  const TradeoffScene& scene_;
  const SceneReference& reference_;
  const CpuClock& clock_;
  const WorkPrecisionOptions& options_;
  ForceTimer force_;
};

}  // namespace

std::vector<TradeoffContender> tradeoff_contenders(bool solvers) {
  std::vector<TradeoffContender> contenders;
  // compensated methods would draw the curves of the plain ones again
  for (const IntegratorEntry& entry : integrators())
    if (!entry.make()->scheme().compensated) contenders.push_back({std::string(entry.name), entry.make, false, false});
  if (solvers) {
    for (const char* name : {"backward-euler", "baraff-witkin", "ros2", "sdirk2"}) add_solvers(contenders, name);
  }
  for (const IntegratorEntry& entry : integrators())
    if (dynamic_cast<AdaptiveIntegrator*>(entry.make().get()) != nullptr)
      contenders.push_back({fmt::format("{}-adaptive", entry.name), entry.make, true, false});
  if (CvodeAdams::available())
    contenders.push_back({"cvode-adams", [] { return std::make_unique<CvodeAdams>(); }, true, true});
  return contenders;
}

std::string_view name(Standing standing) {
  switch (standing) {
    case Standing::front: return "front";
    case Standing::undecided: return "undecided";
    case Standing::dominated: return "dominated";
    case Standing::useless: return "useless";
    case Standing::failed: return "failed";
  }
  return "?";
}

double WorkPoint::cost_low() const { return costs.empty() ? cost : *std::min_element(costs.begin(), costs.end()); }
double WorkPoint::cost_high() const { return costs.empty() ? cost : *std::max_element(costs.begin(), costs.end()); }

WorkPrecision work_precision(const TradeoffScene& scene, const SceneReference& reference,
                             std::span<const TradeoffContender> contenders, const CpuClock& clock,
                             const WorkPrecisionOptions& options, const std::function<void(const WorkPoint&)>& each) {
  WorkPrecision result;
  result.scene = scene.name;
  result.what = scene.what;
  result.reference = reference;
  result.reference.states.clear();
  result.fastest_rate = scene.fastest_rate;
  result.duration = scene.duration;
  result.edge = scene.edge;
  result.vertices = scene.motion.network.point_count();
  const SceneStage start(scene);
  result.springs = start.system().springs.size();
  result.pieces = pieces_of(start.system());
  result.omissions = scene.omissions;
  result.useless_from = std::min(1.0, error_of_rest(scene, reference));

  Study study(scene, reference, clock, options);
  const double phase = scene.fastest_rate * scene.duration;
  const std::uint64_t checkpoints = scene.motion.checkpoints.size();

  // a random order, so that no method always follows the same other one
  std::vector<std::size_t> order(contenders.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  SplitMix64 random(options.seed);
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);

  std::vector<std::vector<WorkPoint>> by_contender(contenders.size());
  for (const std::size_t which : order) {
    const TradeoffContender& contender = contenders[which];
    if (contender.adaptive && !scene.equal_steps().empty()) {
      result.omissions.push_back(fmt::format("{}: {}", contender.name, scene.equal_steps()));
      continue;
    }
    const auto scheme = contender.make()->scheme();
    if (!takes(scene, scheme.name)) {
      result.omissions.push_back(fmt::format("{}: contact between bodies has kinks", contender.name));
      continue;
    }
    auto& points = by_contender[which];
    const double first =
        scheme.implicit ? options.largest_implicit : 2.2 * std::clamp(scheme.imaginary_limit, 1.0, 20.0);
    RunSetting setting{.steps = checkpoints};
    if (contender.adaptive)
      setting = {.tolerance = 1e-2};
    else
      while (phase / static_cast<double>(setting.steps) > first) setting.steps *= 2;
    for (;;) {
      points.push_back(study.measure(contender, setting));
      if (each) each(points.back());
      const WorkPoint& last = points.back();
      const double error = last.errors.x;
      if (!last.failed() && error < 3.0 * reference.floor) break;
      if (!last.failed() && error <= options.enough_error) break;
      if (const double reached = error * std::pow(last.cpu_s / options.most_s, scheme.order + 0.5);
          !last.failed() && error < result.useless_from && reached > options.useful_error) {
        result.omissions.push_back(
            fmt::format("{}: nothing below h omega_max = {:.2g}, within {:g} s it would come to {:.1e} at best",
                        contender.name, last.h_omega, options.most_s, reached));
        break;
      }
      // rounding: two smaller steps have not helped
      if (points.size() > 2 && !last.failed() && error < 1e-8 && error > 0.5 * points[points.size() - 3].errors.x)
        break;
      const double growth = contender.adaptive ? 1.6 : 2.0;
      if (last.code == to_string(StepCode::budget) || (!last.failed() && growth * last.cpu_s > options.most_s)) {
        result.omissions.push_back(
            fmt::format("{}: nothing below {}, a run would take more than {:g} s", contender.name,
                        contender.adaptive ? fmt::format("a tolerance of {:.0e}", setting.tolerance)
                                           : fmt::format("h omega_max = {:.2g}", last.h_omega),
                        options.most_s));
        break;
      }
      if (contender.adaptive) {
        setting.tolerance /= 10.0;
        if (setting.tolerance < 1e-15) break;
      } else {
        if (last.failed() && last.h_omega < 1e-3) break;
        setting.steps *= 2;
      }
    }
  }
  for (auto& points : by_contender)
    result.points.insert(result.points.end(), std::make_move_iterator(points.begin()),
                         std::make_move_iterator(points.end()));
  classify(result.points, reference.floor, result.useless_from);
  return result;
}

double error_of_rest(const TradeoffScene& scene, const SceneReference& reference) {
  std::vector<PointState> states;
  PointState now = scene.motion.start;
  std::size_t interval = 0;
  for (std::size_t c = 0; c < scene.motion.checkpoints.size(); ++c) {
    for (; interval < scene.motion.interval_at(c); ++interval) {
      PointState next;
      for (const std::uint32_t from : scene.motion.events[interval].from) {
        next.x.push_back(now.x[from]);
        next.v.push_back(now.v[from]);
      }
      now = std::move(next);
    }
    states.push_back(now);
  }
  return reference::motion_errors(scene.motion, states, reference.states).x;
}

void classify(std::span<WorkPoint> points, double floor, double useless_from) {
  // NaN is not less than anything
  for (WorkPoint& p : points)
    p.standing = p.failed() ? Standing::failed : p.errors.x < useless_from ? Standing::front : Standing::useless;
  for (WorkPoint& p : points) {
    if (!is_useful(p)) continue;
    const double error = std::max(p.errors.x, floor);
    for (const WorkPoint& q : points) {
      if (&q == &p || !is_useful(q)) continue;
      const double other = std::max(q.errors.x, floor);
      if (other > error || (other == error && q.cost >= p.cost)) continue;
      if (q.cost_high() < p.cost_low()) {
        p.standing = Standing::dominated;
        break;
      }
      if (q.cost < p.cost) p.standing = Standing::undecided;
    }
  }
}

namespace {

struct Need {
  double cost = infinity, evaluations = 0.0, h = 0.0;
};

Need need_at(std::span<const WorkPoint> points, std::string_view contender, double error) {
  Need best;
  const auto evaluations = [](const WorkPoint& p) { return static_cast<double>(p.work.force_evaluations); };
  const auto consider = [&best](double cost, double count, double h) {
    if (cost < best.cost) best = {cost, count, h};
  };
  const WorkPoint* previous = nullptr;
  for (const WorkPoint& p : points) {
    if (p.contender != contender) continue;
    if (!is_useful(p)) {
      previous = nullptr;
      continue;
    }
    if (p.errors.x <= error) {
      consider(p.cost, evaluations(p), p.h);
      if (previous != nullptr && previous->errors.x > error && p.errors.x > 0.0) {
        const double s = std::log(previous->errors.x / error) / std::log(previous->errors.x / p.errors.x);
        const double count = evaluations(*previous) > 0.0
                                 ? evaluations(*previous) * std::pow(evaluations(p) / evaluations(*previous), s)
                                 : evaluations(p);
        consider(previous->cost * std::pow(p.cost / previous->cost, s), count,
                 previous->h * std::pow(p.h / previous->h, s));
      }
    }
    previous = &p;
  }
  return best;
}

}  // namespace

double cost_at(std::span<const WorkPoint> points, std::string_view contender, double error) {
  return need_at(points, contender, error).cost;
}

std::vector<Winner> winners(std::span<const WorkPoint> points, std::span<const double> errors) {
  std::set<std::string> contenders;
  for (const WorkPoint& p : points)
    if (!p.peer) contenders.insert(p.contender);
  std::vector<Winner> result;
  for (const double error : errors) {
    std::vector<std::pair<double, std::string>> order;
    for (const std::string& contender : contenders)
      if (const double cost = cost_at(points, contender, error); cost < infinity) order.emplace_back(cost, contender);
    std::sort(order.begin(), order.end());
    Winner winner{.error = error};
    if (!order.empty()) {
      std::tie(winner.cost, winner.contender) = order[0];
      const Need need = need_at(points, winner.contender, error);
      winner.evaluations = need.evaluations;
      winner.h = need.h;
    }
    if (order.size() > 1) std::tie(winner.runner_up_cost, winner.runner_up) = order[1];
    result.push_back(std::move(winner));
  }
  return result;
}

std::vector<Regret> regrets(std::span<const WorkPoint> points, std::span<const double> errors) {
  const std::vector<Winner> best = winners(points, errors);
  std::vector<Regret> result;
  for (const WorkPoint& p : points) {
    if (std::ranges::find(result, p.contender, &Regret::contender) != result.end()) continue;
    Regret regret{p.contender, p.peer, {}, 0.0};
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const double cost = cost_at(points, p.contender, errors[k]);
      regret.of_error.push_back(best[k].contender.empty() ? infinity : cost / best[k].cost);
      regret.worst = max_or_nan(regret.worst, regret.of_error.back());
    }
    result.push_back(std::move(regret));
  }
  return result;
}

}  // namespace dartboard
