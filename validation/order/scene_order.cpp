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

/// The last orders in the window that follow each other.
struct LastOrders {
  double x, v;         // the least in x, and in v
  double least, most;  // of the smaller of the two
  bool counts = true;  // against the method
};
std::optional<LastOrders> last_orders(const OrderStudy& study, const OrderOptions& options) {
  std::vector<const OrderPoint*> last;
  for (const OrderPoint& p : study.points) {
    if (p.regime == Regime::floor) continue;
    const bool counts = (p.regime == Regime::pre_asymptotic || p.regime == Regime::asymptotic) && p.has_order;
    counts ? last.push_back(&p) : last.clear();
  }
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

void require_smooth(const TradeoffScene& scene) {
  if (scene.has_contact())
    throw InputError(fmt::format(
        "{}: /contact: has kinks, across which no method shows its order; expected none: 'tradeoff' measures errors",
        scene.frozen->file.file));
}

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

SceneOrder observe_order(const TradeoffScene& scene, const SceneReference& reference, const IntegratorEntry& entry,
                         const CpuClock& clock, const SceneOrderOptions& options) {
  const auto integrator = entry.make();
  OrderStudy study{std::string(entry.name), OrderCase::undamped, integrator->scheme().order, {}, false, 0.0, 0.0, ""};
  OrderOptions judging = options.order;
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
    SceneOrder found = answer_of(study, judging);
    if (found.answer == OrderAnswer::shown || study.points.back().regime == Regime::floor) return found;
    if (2 * run.cpu_ns > most_ns || halvings == options.most_halvings) {
      if (found.answer == OrderAnswer::open) found.study.reason += "; more steps would take too long";
      return found;
    }
  }
}

}  // namespace dartboard
