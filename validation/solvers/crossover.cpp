#include "validation/solvers/crossover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/median.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "reference/error_norms.h"

namespace dartboard {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::string_view explicit_method = "verlet";
// the two that were ahead on the stiff scenes of `tradeoff` at errors of 1e-2 to 1e-3 edges
constexpr std::string_view implicit_methods[]{"implicit-midpoint", "sdirk2"};
constexpr double StepPrices::*parts[]{&StepPrices::linearisation, &StepPrices::factorisation, &StepPrices::solve};

class Study {
 public:
  Study(int side, const CrossoverOptions& options, const CpuClock& clock)
      : options_(options),
        clock_(clock),
        mesh_(kuhn_box(side - 1, side - 1, side - 1, 0.1, 0.25, 1)),
        pilot_scene_(scene(options.pilot_factor)),
        force_(pilot_scene_, clock) {}

  TradeoffScene scene(double factor) const {
    return stiff_scene("a box with a stiff inclusion", mesh_, factor, {.phase = 13.2, .checkpoints = 4});
  }
  TimedRun run(const TradeoffScene& scene, std::string_view method, double steps) const {
    const auto integrator = make_integrator(method);
    return run_timed(scene, *integrator, {.steps = static_cast<std::uint64_t>(std::ceil(steps))}, clock_);
  }
  /// The same run at least three times, and more often while that is quick.
  struct Timed {
    TimedRun run;
    double forces = 0.0;  // its cost in evaluations of the forces, timed before and after each run: the median
  };
  Timed run_well(const TradeoffScene& scene, std::string_view method, double steps) {
    Timed timed;
    std::vector<double> forces;
    std::int64_t total = 0;
    double before = time_force();
    for (int k = 0; k < 3 || (k < 9 && total < 500'000'000); ++k) {
      timed.run = run(scene, method, steps);
      if (!timed.run.result.ok()) return timed;
      total += timed.run.cpu_ns;
      const double after = time_force();
      forces.push_back(static_cast<double>(timed.run.cpu_ns) / (0.5 * (before + after)));
      before = after;
    }
    timed.forces = median_of(forces);
    return timed;
  }
  double seconds(const Timed& timed) const { return 1e-9 * force_ns_ * timed.forces; }
  double distance(const TradeoffScene& scene, const TimedRun& a, const TimedRun& b) const {
    return reference::motion_errors(scene.motion, a.states, b.states).x;
  }
  double limit(const TradeoffScene& scene) const {
    return scheme_of(explicit_method).imaginary_limit / scene.fastest_rate;
  }

  /// Prediction from pilots at one stiffness; infinite seconds when they fail.
  struct Prediction {
    std::string method;
    ImplicitWork work;
    StepPrices prices;
    double steps = 0.0, seconds = infinity, explicit_step_s = 0.0, phase = infinity;
    double overhead = 1.0;  // of a pilot over the law for its own counts
    ImplicitWork pilot_work;
    double pilot_steps = 0.0, pilot_forces = 0.0;
  };
  Prediction predict(double factor) {
    const TradeoffScene at = scene(factor);
    const auto pilot = static_cast<double>(options_.pilot_steps);
    std::vector<Prediction> all;
    for (const std::string_view method : implicit_methods) {
      sample_prices(at);
      const TimedRun coarse = run(at, method, pilot);
      const Timed timed = run_well(at, method, 2.0 * pilot);
      const TimedRun& fine = timed.run;
      if (!coarse.result.ok() || !fine.result.ok()) continue;
      const int order = scheme_of(method).order;
      const double error = distance(at, coarse, fine) / (std::exp2(order) - 1.0);
      Prediction p;
      p.method = method;
      p.work = implicit_work(fine.work);
      p.steps = 2.0 * pilot * std::pow(error / options_.error, 1.0 / order);
      // a longer step needs more iterations: by the power that the pilots show
      const double more = std::log2(implicit_work(coarse.work).solves / p.work.solves);
      p.work.solves *= std::pow(2.0 * pilot / p.steps, std::clamp(more, 0.0, 1.0));
      p.pilot_steps = static_cast<double>(fine.work.steps);
      p.pilot_forces = timed.forces;
      p.pilot_work = implicit_work(fine.work);
      all.push_back(std::move(p));
    }
    sample_prices(at);
    const StepPrices now = prices();
    Prediction best;
    for (Prediction& p : all) {
      p.prices = now;
      p.overhead =
          std::max(1.0, 1e-9 * force_ns_ * p.pilot_forces / implicit_seconds(p.pilot_steps, p.pilot_work, now));
      p.seconds = p.overhead * implicit_seconds(p.steps, p.work, now);
      if (p.seconds < best.seconds) best = p;
    }
    best.explicit_step_s = 1e-9 * force_ns_ * median_of(explicit_step_);
    best.phase = break_even_phase(scheme_of(explicit_method).imaginary_limit, best.explicit_step_s, best.seconds);
    return best;
  }

  CostPair measure(double factor, std::string_view method, double steps) {
    const TradeoffScene at = scene(factor);
    CostPair costs;
    costs.factor = factor;
    costs.phase = at.duration * at.fastest_rate;
    costs.implicit_method = method;
    const double stable = steps_for_stability(at.duration, limit(at));
    const Timed quick = run_well(at, explicit_method, stable);
    const TimedRun exact = run(at, explicit_method, 2.0 * stable);
    if (!quick.run.result.ok() || !exact.result.ok()) return costs;
    costs.explicit_s = seconds(quick);
    costs.explicit_error = distance(at, quick.run, exact);

    // Runs on either side of the error, or near it; between them costs and steps are powers of the error.
    struct Point {
      double steps, error, seconds;
    };
    std::vector<Point> points;
    const auto order = static_cast<double>(scheme_of(method).order);
    double next = std::max(4.0, steps);
    for (int k = 0; k < 4; ++k) {
      const Timed implicit = run_well(at, method, next);
      if (!implicit.run.result.ok()) {
        next *= 1.5;
        continue;
      }
      points.push_back(
          {static_cast<double>(implicit.run.work.steps), distance(at, implicit.run, exact), seconds(implicit)});
      const Point& last = points.back();
      if (points.size() >= 2) {
        const Point& before = points[points.size() - 2];
        if (std::max(before.error, last.error) >= options_.error &&
            std::min(before.error, last.error) <= options_.error)
          break;
      }
      const double wanted = last.steps * std::pow(last.error / options_.error, 1.0 / order);
      // a whole number of steps between checkpoints, on the other side of the error
      next = last.error > options_.error ? std::max(last.steps + 4.0, 4.0 * std::ceil(wanted / 4.0))
                                         : std::min(last.steps - 4.0, 4.0 * std::floor(wanted / 4.0));
      if (next < 4.0) break;
    }
    if (points.empty()) return costs;
    const Point &b = points.back(), &a = points.size() > 1 ? points[points.size() - 2] : b;
    const double part = a.error == b.error
                            ? 0.0
                            : std::clamp(std::log(options_.error / b.error) / std::log(a.error / b.error), -0.5, 1.5);
    costs.implicit_s = b.seconds * std::pow(a.seconds / b.seconds, part);
    costs.implicit_steps = b.steps * std::pow(a.steps / b.steps, part);
    return costs;
  }

 private:
  double time_force() {
    const double ns = force_.measure();
    force_ns_ = std::min(force_ns_, ns);
    return ns;
  }

  // Prices do not depend on the stiffness. All are taken in evaluations of the forces at the same moment, and between
  // the pilots: a machine changes its pace from one second to the next, by as much as the error of the law.
  void sample_prices(const TradeoffScene& at) {
    for (int k = 0; k < 3; ++k) {
      const StepPrices now = step_prices(at, at.duration / static_cast<double>(options_.pilot_steps), clock_);
      for (std::size_t p = 0; p < std::size(parts); ++p) samples_[p].push_back(now.*parts[p] / now.force);
    }
    // a whole run at the stiffness of the first pilots: as much caching and disturbance as in those that are predicted
    const Timed pilot =
        run_well(pilot_scene_, explicit_method, steps_for_stability(pilot_scene_.duration, limit(pilot_scene_)));
    explicit_step_.push_back(pilot.forces / static_cast<double>(pilot.run.work.steps));
  }
  StepPrices prices() const {
    StepPrices result;
    result.force = 1e-9 * force_ns_;
    for (std::size_t p = 0; p < std::size(parts); ++p) result.*parts[p] = result.force * median_of(samples_[p]);
    return result;
  }

  CrossoverOptions options_;
  CpuClock clock_;
  Mesh mesh_;
  TradeoffScene pilot_scene_;
  ForceTimer force_;
  double force_ns_ = infinity;                     // the least of all: for printed times, not for ratios
  std::vector<double> samples_[std::size(parts)];  // of prices, in evaluations of the forces
  std::vector<double> explicit_step_;              // the same of an explicit step
};

}  // namespace

std::optional<Crossover::Enclosure> Crossover::enclosure() const {
  double explicit_wins = 0.0, implicit_wins = infinity;
  for (const CostPair& c : costs) {
    if (c.ratio() < 1.0)
      explicit_wins = std::max(explicit_wins, c.phase);
    else
      implicit_wins = std::min(implicit_wins, c.phase);
  }
  if (explicit_wins == 0.0 || implicit_wins == infinity) return {};
  return Enclosure{std::min(explicit_wins, implicit_wins), std::max(explicit_wins, implicit_wins)};
}

Crossover find_crossover(int side, const CrossoverOptions& options, const CpuClock& clock,
                         const std::function<void(const CostPair&)>& each) {
  Study study(side, options, clock);
  Crossover result;
  result.explicit_method = explicit_method;
  // omega_max^2 is proportional to the factor as soon as the inclusion has the largest frequency
  const auto factor_of = [](double factor, double phase, double wanted) {
    return factor * (wanted / phase) * (wanted / phase);
  };
  const TradeoffScene first_scene = study.scene(options.pilot_factor);
  result.vertices = first_scene.motion.network.point_count();
  result.springs = first_scene.motion.network.springs.size();
  const double first_phase = first_scene.duration * first_scene.fastest_rate;
  const Study::Prediction first = study.predict(options.pilot_factor);
  result.first_phase = first.phase;
  if (!std::isfinite(first.phase)) {
    result.failure = "the pilots fail";
    return result;
  }
  const Study::Prediction p = study.predict(factor_of(options.pilot_factor, first_phase, first.phase));
  if (!std::isfinite(p.phase)) {
    result.failure = "the pilots fail at the stiffness predicted";
    return result;
  }
  result.prices = p.prices;
  result.explicit_step_s = p.explicit_step_s;
  result.implicit_method = p.method;
  result.work = p.work;
  result.predicted_steps = p.steps;
  result.predicted_s = p.seconds;
  result.overhead = p.overhead;
  result.predicted_phase = p.phase;
  result.predicted_factor = factor_of(options.pilot_factor, first_phase, p.phase);

  // by false position between factors on either side, the next from a ratio that grows as the root of the factor
  const CostPair *low = nullptr, *high = nullptr;
  double factor = result.predicted_factor;
  result.costs.reserve(static_cast<std::size_t>(options.most_evaluations));
  for (int k = 0; k < options.most_evaluations; ++k) {
    CostPair costs;
    for (const std::string_view method : implicit_methods) {
      const CostPair c = study.measure(factor, method, p.steps);
      if (costs.implicit_s == 0.0 || (c.implicit_s > 0.0 && c.implicit_s < costs.implicit_s)) costs = c;
    }
    if (!(costs.implicit_s > 0.0) || !(costs.explicit_s > 0.0)) {
      result.failure = "a run fails";
      return result;
    }
    result.costs.push_back(costs);
    if (each) each(costs);
    const CostPair& now = result.costs.back();
    (now.ratio() < 1.0 ? low : high) = &now;
    if (std::abs(std::log(now.ratio())) < 0.03) {
      result.measured_phase = now.phase;
      break;
    }
    if (low != nullptr && high != nullptr) {
      const double part = std::log(1.0 / low->ratio()) / std::log(high->ratio() / low->ratio());
      result.measured_phase = low->phase * std::pow(high->phase / low->phase, part);
      if (high->phase < 1.3 * low->phase) break;
      factor = low->factor * std::pow(high->factor / low->factor, std::clamp(part, 0.1, 0.9));
    } else {
      // a little beyond, to have it enclosed
      const double beyond = now.ratio() < 1.0 ? 1.21 : 1.0 / 1.21;
      factor = beyond * now.factor / std::clamp(now.ratio() * now.ratio(), 1.0 / 64.0, 64.0);
    }
  }
  if (low == nullptr || high == nullptr)
    if (result.measured_phase == 0.0) {
      result.failure = "the crossover was not enclosed";
      return result;
    }
  result.measured_factor = factor_of(options.pilot_factor, first_phase, result.measured_phase);
  return result;
}

}  // namespace dartboard
