#include "validation/order/scene_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/time/solve/step_solver.h"
#include "validation/tradeoff/rounding_floor.h"

namespace dartboard {
namespace {

constexpr double asymptotic_h_omega = 0.25;  // the longest steps whose order counts against a method
constexpr double half_an_order = 0.5;
constexpr std::size_t errors_to_fit = 5;
constexpr double fitted_tolerance = 0.3;  // of orders through contact
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The floor of velocities, relative to the largest root mean square of them, over that of positions in edges.
double floor_of_velocities(const TradeoffScene& scene, const SceneReference& reference) {
  double largest = 0.0;
  for (std::size_t c = 0; c < reference.states.size(); ++c) {
    const reference::SpringNetwork& network = scene.motion.network_of(scene.motion.interval_at(c));
    double mass = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < network.point_count(); ++i) {
      mass += network.mass[i];
      sum += network.mass[i] * reference.states[c].v[i].squaredNorm();
    }
    if (mass > 0.0) largest = max_or_nan(largest, std::sqrt(sum / mass));
  }
  return std::max(1.0, scene.fastest_rate * scene.edge / largest);
}

/// The longest steps, as a number of them that suits the checkpoints.
std::uint64_t fewest_steps(const TradeoffScene& scene, double h_omega) {
  const auto intervals = static_cast<double>(scene.motion.checkpoints.size());
  const double each = std::max(1.0, std::ceil(scene.fastest_rate * scene.duration / h_omega / intervals));
  return static_cast<std::uint64_t>(each * intervals);
}

/// The last points in the window that follow each other, less those at the floor behind them.
std::vector<const OrderPoint*> last_in_window(const OrderStudy& study) {
  std::vector<const OrderPoint*> last;
  for (const OrderPoint& p : study.points) {
    if (p.regime == Regime::floor) continue;
    p.regime == Regime::pre_asymptotic || p.regime == Regime::asymptotic ? last.push_back(&p) : last.clear();
  }
  return last;
}

/// The last orders in the window that follow each other.
struct LastOrders {
  double x, v;         // the least in x, and in v
  double least, most;  // of the smaller of the two
  bool counts = true;  // against the method
};
std::optional<LastOrders> last_orders(const OrderStudy& study, const OrderOptions& options) {
  std::vector<const OrderPoint*> last = last_in_window(study);
  if (!last.empty() && !last.front()->has_order) last.erase(last.begin());  // there was no run to compare with
  const auto wanted = static_cast<std::size_t>(options.successive);
  if (last.size() < wanted) return {};
  LastOrders found{infinity, infinity, infinity, -infinity};
  for (const OrderPoint* p : std::span(last).last(wanted)) {
    found.x = std::min(found.x, p->p_x);
    found.v = std::min(found.v, p->p_v);
    found.least = std::min({found.least, p->p_x, p->p_v});
    found.most = std::max(found.most, std::min(p->p_x, p->p_v));
    found.counts = found.counts && p->h_omega <= asymptotic_h_omega &&
                   p->errors.v >= 10.0 * options.solved_to * static_cast<double>(p->steps);
  }
  return found;
}

/// The orders with which the last successive errors in the window fall, by least squares.
struct FittedOrders {
  std::size_t errors = 0;                    // without three there are no orders
  double x = 0.0, v = 0.0, deviation = 0.0;  // the larger of the two standard errors
  bool counts = false;                       // against the method: the last halvings are of short steps
};

FittedOrders fitted_orders(const OrderStudy& study) {
  const std::vector<const OrderPoint*> last = last_in_window(study);
  FittedOrders fit{.errors = last.size()};
  if (last.size() < 3) return fit;
  const auto n = static_cast<double>(last.size());
  const double spread = n * (n * n - 1.0) / 12.0;  // sum of squares of 0 .. n - 1 about their mean
  const auto fall = [&](auto error_of) {
    double mean = 0.0, slope = 0.0, left = 0.0;
    for (const OrderPoint* p : last) mean += std::log2(error_of(*p)) / n;
    for (std::size_t k = 0; k < last.size(); ++k)
      slope += (static_cast<double>(k) - 0.5 * (n - 1.0)) * (std::log2(error_of(*last[k])) - mean) / spread;
    for (std::size_t k = 0; k < last.size(); ++k) {
      const double line = mean + slope * (static_cast<double>(k) - 0.5 * (n - 1.0));
      left += std::pow(std::log2(error_of(*last[k])) - line, 2);
    }
    fit.deviation = max_or_nan(fit.deviation, std::sqrt(left / (n - 2.0) / spread));
    return -slope;
  };
  fit.x = fall([](const OrderPoint& p) { return p.errors.x; });
  fit.v = fall([](const OrderPoint& p) { return p.errors.v; });
  fit.counts = last[last.size() - 3]->h_omega <= asymptotic_h_omega;
  return fit;
}

std::string reason_for_open(const OrderStudy& study, const OrderOptions& options) {
  if (study.points.empty()) return "no run";
  const OrderPoint& last = study.points.back();
  switch (last.regime) {
    case Regime::failed: return last.diagnosis;
    case Regime::floor: return "the errors reach the floor first";
    case Regime::large:
      return fmt::format("errors of {:.1e} edges and {:.1e} of the speed with {} steps are too large", last.errors.x,
                         last.errors.v, last.steps);
    default:
      return fmt::format("no {} successive orders within {:g} of it in {} steps", options.successive, options.tolerance,
                         last.steps);
  }
}

}  // namespace

SceneOrder answer_of(OrderStudy judged, const OrderOptions& options) {
  SceneOrder result{.study = std::move(judged)};
  OrderStudy& study = result.study;
  if (study.holds) {
    result.answer = OrderAnswer::shown;
    return result;
  }
  study.reason = reason_for_open(study, options);
  const std::optional<LastOrders> last = last_orders(study, options);
  if (!last) return result;
  if (last->least >= study.theory - options.tolerance && last->most <= study.theory + options.tolerance) {
    result.answer = OrderAnswer::shown;
    study.reason.clear();
    study.p_x = last->x;
    study.p_v = last->v;
  } else if (last->most - last->least <= 2.0 * options.tolerance) {
    const std::string shows = fmt::format("order {:.2f} in x and {:.2f} in v", last->x, last->v);
    if (last->counts && last->most <= study.theory - half_an_order) {
      result.answer = OrderAnswer::missed;
      study.reason = shows;
    } else if (last->least >= study.theory + half_an_order) {
      study.reason = shows + ", which is more than it promises";
    }
  }
  return result;
}

SceneOrder answer_by_fit(OrderStudy judged, const OrderLimit& limit, const OrderOptions& options) {
  SceneOrder result{.study = std::move(judged)};
  OrderStudy& study = result.study;
  const FittedOrders fit = fitted_orders(study);
  if (fit.errors < errors_to_fit) {
    study.reason = reason_for_open(study, options);
    return result;
  }
  study.holds = false;
  study.p_x = fit.x;
  study.p_v = fit.v;
  const std::string shows =
      fmt::format("order {:.2f} in x and {:.2f} in v, fitted to {} errors", fit.x, fit.v, fit.errors);
  const double fitted = std::min(fit.x, fit.v), least = study.theory - fitted_tolerance;
  study.reason = shows;
  if (!limit.is_promised()) {
    study.reason += "; none is promised";
  } else if (fitted >= least) {
    result.answer = OrderAnswer::shown;
    study.reason.clear();
  } else if (fit.counts && fitted + 2.0 * fit.deviation < least) {
    result.answer = OrderAnswer::missed;
  }
  return result;
}

SceneOrder observe_order(const TradeoffScene& scene, const SceneReference& reference, const IntegratorEntry& entry,
                         const CpuClock& clock, const SceneOrderOptions& options) {
  const auto integrator = entry.make();
  const OrderLimit limit = order_limit(scene);
  const double order = limit.of(integrator->scheme());
  OrderStudy study{std::string(entry.name), OrderCase::undamped, order, {}, false, 0.0, 0.0, ""};
  OrderOptions judging = options.order;
  if (!takes(scene, entry.name)) study.reason = "contact between bodies has kinks";
  if (!(10.0 * reference.floor < judging.most_error))
    study.reason = fmt::format("the reference resolves no errors below {:.1e} edges", reference.floor);
  if (!study.reason.empty()) return {std::move(study), OrderAnswer::open};
  judging.velocity_floor = floor_of_velocities(scene, reference);
  if (integrator->scheme().implicit) judging.solved_to = ImplicitOptions{}.tolerance;
  const RoundingFloor rounding = rounding_floor(scene, integrator->scheme());
  const auto most_ns = static_cast<std::int64_t>(1e9 * options.most_s);
  RunSetting setting{.steps = fewest_steps(scene, options.first_h_omega)};
  for (int halvings = 0;; ++halvings, setting.parts *= 2) {
    const TimedRun run = run_timed(scene, *integrator, setting, clock, {.cpu_ns = most_ns});
    OrderPoint point;
    point.steps = setting.steps * setting.parts;
    point.h_omega = run.h * scene.fastest_rate;
    if (run.result.ok())
      point.errors = reference::motion_errors(scene.motion, run.states, reference.states);
    else
      point.diagnosis = to_string(run.result);
    study.points.push_back(std::move(point));
    judge(study, std::max(reference.floor, std::max(1.0, reference.gain) * rounding.at(run.h)), judging);
    SceneOrder found = scene.equal_steps().empty() ? answer_of(study, judging) : answer_by_fit(study, limit, judging);
    if (found.answer == OrderAnswer::shown || study.points.back().regime == Regime::floor) return found;
    if (!limit.is_promised() && last_in_window(study).size() >= errors_to_fit) return found;
    if (2 * run.cpu_ns > most_ns || halvings == options.most_halvings) {
      if (found.answer == OrderAnswer::open) found.study.reason += "; more steps would take too long";
      return found;
    }
  }
}

}  // namespace dartboard
