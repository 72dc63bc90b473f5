#include "validation/order/convergence_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/scenes/scene_stage.h"

namespace dartboard {
namespace {

// The value whose distance from the theory is larger.
double farther(double theory, double a, double b) { return std::abs(b - theory) > std::abs(a - theory) ? b : a; }

bool at_most(double error, double bound) { return error <= bound; }  // false for NaN

void take_orders(OrderStudy& study) {
  const std::size_t apart = study.which == OrderCase::unaligned_cut ? 2 : 1;
  for (std::size_t k = apart; k < study.points.size(); ++k) {
    OrderPoint& now = study.points[k];
    const OrderPoint& before = study.points[k - apart];
    now.has_order = now.diagnosis.empty() && before.diagnosis.empty();
    if (!now.has_order) continue;
    now.p_x = std::log2(before.errors.x / now.errors.x) / static_cast<double>(apart);
    now.p_v = std::log2(before.errors.v / now.errors.v) / static_cast<double>(apart);
  }
}

bool within(const OrderStudy& study, const OrderPoint& point, const OrderOptions& options) {
  return point.has_order && std::abs(point.p_x - study.theory) <= options.tolerance &&
         std::abs(point.p_v - study.theory) <= options.tolerance;
}

}  // namespace

std::string_view name(Regime regime) {
  switch (regime) {
    case Regime::failed: return "failed";
    case Regime::large: return "large";
    case Regime::pre_asymptotic: return "pre-asymptotic";
    case Regime::asymptotic: return "asymptotic";
    case Regime::floor: return "floor";
  }
  return "?";
}

OrderStage order_stage(OrderCase which) {
  TradeoffScene scene = tradeoff_scene({}, order_scene(which));
  // in extended precision throughout, so that the floor is low enough for three halvings of a method of order 5
  reference::CertifyOptions options;
  options.step_times_rate = 0.1;
  options.extrapolation = true;
  reference::CertifiedMotion certified = reference::certify(scene.motion, options);
  return {which, std::move(scene), std::move(certified)};
}

void judge(OrderStudy& study, double floor, const OrderOptions& options) {
  take_orders(study);
  const double least_x = 10 * floor, least_v = least_x * options.velocity_floor;
  const auto in_window = [&](const OrderPoint& p) {
    return p.diagnosis.empty() && at_most(p.errors.x, options.most_error) && at_most(p.errors.v, options.most_error) &&
           p.errors.x >= least_x && p.errors.v >= least_v;
  };
  int run = 0;
  study.holds = false;
  const OrderPoint* last = nullptr;
  for (std::size_t k = 0; k < study.points.size(); ++k) {
    OrderPoint& p = study.points[k];
    const bool below = p.diagnosis.empty() && (p.errors.x < least_x || p.errors.v < least_v);
    p.regime = !p.diagnosis.empty() ? Regime::failed
               : below              ? Regime::floor
               : in_window(p)       ? Regime::pre_asymptotic
                                    : Regime::large;
    if (in_window(p) && within(study, p, options)) p.regime = Regime::asymptotic;
    if (in_window(p) && p.has_order) last = &p;
    // the error that an order starts from may be above the window; the one it ends with is within
    run = p.regime == Regime::asymptotic ? run + 1 : 0;
    if (run == options.successive && !study.holds) {
      study.holds = true;
      study.p_x = study.p_v = study.theory;
      for (int back = 0; back < run; ++back) {
        const OrderPoint& used = study.points[k - static_cast<std::size_t>(back)];
        study.p_x = farther(study.theory, study.p_x, used.p_x);
        study.p_v = farther(study.theory, study.p_v, used.p_v);
      }
    }
  }
  if (study.holds) {
    study.reason.clear();
    return;
  }
  if (last != nullptr) {
    study.p_x = last->p_x;
    study.p_v = last->p_v;
  }
  if (study.points.empty() || !study.points.back().diagnosis.empty())
    study.reason = study.points.empty() ? "no run" : study.points.back().diagnosis;
  else if (study.points.back().regime == Regime::floor)
    study.reason = "the errors reach the floor first";
  else
    study.reason = fmt::format("not within {} steps", study.points.back().steps);
}

OrderStudy study_order(const OrderStage& stage, const IntegratorEntry& entry, const OrderOptions& options) {
  const auto integrator = entry.make();
  const double theory = stage.which == OrderCase::unaligned_cut ? 1.0 : integrator->scheme().order;
  OrderStudy study{std::string(entry.name), stage.which, theory, {}, false, 0.0, 0.0, ""};
  if (!stage.certified.accepted) {
    study.reason = "the reference is not certified";
    return study;
  }
  const auto timing = stage.which == OrderCase::unaligned_cut ? EventTiming::end_of_step : EventTiming::split_step;
  const std::uint64_t most = integrator->scheme().implicit ? options.most_implicit_steps : options.most_steps;
  for (std::uint64_t steps = options.fewest_steps; steps <= most; steps *= 2) {
    const TimedRun run = run_timed(stage.scene, *integrator, {.steps = steps, .timing = timing}, no_clock);
    OrderPoint point;
    point.steps = steps;
    point.h_omega = run.h * stage.scene.fastest_rate;
    if (run.result.ok())
      point.errors = reference::motion_errors(stage.scene.motion, run.states, stage.certified.states);
    else
      point.diagnosis = to_string(run.result);
    study.points.push_back(std::move(point));
    judge(study, stage.certified.floor, options);
    if (study.holds || study.points.back().regime == Regime::floor) break;
  }
  return study;
}

}  // namespace dartboard
