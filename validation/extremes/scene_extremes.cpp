#include "validation/extremes/scene_extremes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plain/nan_maximum.h"
#include "core/time/integrators.h"
#include "core/time/method/trial_state.h"
#include "core/time/system/energy.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/preflight.h"
#include "reference/ode_intervals.h"
#include "validation/extremes/extreme_judgement.h"
#include "validation/extremes/extreme_run.h"
#include "validation/extremes/motion_truth.h"
#include "validation/extremes/step_evidence.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t steps_in_all = 100;
constexpr double most_seconds = 10.0;       // [s] of processor time that a run may take, without its judges
constexpr std::size_t largest_dense = 200;  // vertices: witnesses with dense factors take a second a step
constexpr double truth_seconds = 5.0;       // [s] that a true motion may be expected to take
constexpr double ns_per_spring = 60.0, elements_per_spring = 50.0;  // of an evaluation in extended precision

/// The number of changes after a step that have taken place by then.
std::size_t changes_by(std::uint64_t step, std::uint64_t steps, std::size_t changes) {
  // change k comes after step floor(steps (k + 1) / (changes + 1))
  std::size_t count = 0;
  while (count < changes && steps * (count + 1) / (changes + 1) <= step) ++count;
  return count;
}

/// The size of a network for the witnesses, in springs.
double springs_of(const reference::SpringNetwork& network) {
  return static_cast<double>(network.springs.size()) +
         elements_per_spring * static_cast<double>(network.elements.size());
}

/// The end of the true motion of a scene, and its start with every vertex where it comes from. All integrators of one
/// step ask for the same one, one after the other.
class SceneTruth {
 public:
  explicit SceneTruth(const TradeoffScene& scene) : scene_(scene) {}

  std::optional<MotionDistance> distance(const PointState& end, double h) {
    if (h != h_) find(h);
    if (!end_ || start_.x.size() != end.x.size()) return {};
    return distance_between(*end_, start_, end, 1.0 / scene_.fastest_rate);
  }

 private:
  void find(double h) {
    h_ = h;
    end_.reset();
    const double each = scene_.fastest_rate * h, in_all = each * steps_in_all / truth_step_times_rate;
    const double seconds = 13.0 * in_all * 1e-9 * ns_per_spring * springs_of(scene_.motion.network);
    if (!(each > 0.0) || !(in_all <= most_truth_steps) || !(seconds <= truth_seconds)) return;
    const std::optional<reference::NetworkMotion> motion = motion_in_steps(scene_, h, steps_in_all);
    if (!motion) return;
    reference::CodeRun run = reference::run_odeint_fehlberg(*motion, truth_step_times_rate);
    if (!run.failure.empty() || run.states.empty()) return;
    end_ = std::move(run.states.front());
    start_ = motion->start;
    for (const reference::NetworkEvent& event : motion->events) {
      PointState next;
      for (const std::uint32_t from : event.from) {
        next.x.push_back(start_.x[from]);
        next.v.push_back(start_.v[from]);
      }
      start_ = std::move(next);
    }
  }

  const TradeoffScene& scene_;
  double h_ = -1.0;
  std::optional<std::vector<long double>> end_;
  PointState start_;
};

/// A run on its way.
class SceneTrial {
 public:
  SceneTrial(const TradeoffScene& scene, SceneTruth& truth, ExtremeCell& cell, double h, const MakeIntegrator& make)
      : scene_(scene),
        truth_(truth),
        cell_(cell),
        h_(h),
        stage_(scene),
        integrator_(make(cell.integrator)),
        evidence_(cell.integrator, steps_in_all, nullptr, judged_steps()) {}

  void run() {
    const Horizon horizon{.steps = static_cast<double>(steps_in_all), .gain = 2.0};
    limits_ = stage_.limits();
    if (!check_before(horizon)) return;
    StepResult result = detector_.start(stage_.system(), stage_.motion(), h_);
    cell_.refused = !result.ok();
    energy_before_ = energy_now();
    supply_ += supply();
    take_up_elements();
    const double deadline = reference::thread_cpu_seconds() + most_seconds;
    while (cell_.step < steps_in_all && result.ok()) {
      result = step();
      ++cell_.step;
      if (result.ok() && cell_.step < steps_in_all) result = change(horizon);
      if (result.ok() && reference::thread_cpu_seconds() > deadline + evidence_.seconds())
        result = {StepCode::budget, Witness::none, 0, "steps", static_cast<double>(cell_.step)};
    }
    if (result.ok()) result = detector_.check_all(stage_.system(), stage_.motion());
    result.ok() ? judge(horizon) : stop(result);
  }

 private:
  JudgedSteps judged_steps() const {
    const double size = std::max(1.0, springs_of(scene_.motion.network));
    const auto most = static_cast<std::uint64_t>(std::clamp(3e5 / size, 3.0, 200.0));
    return {.first = std::min<std::uint64_t>(8, most), .most = most};
  }

  /// False if the run is refused.
  bool check_before(const Horizon& horizon) {
    const Preflight preflight =
        check_before_run(stage_.system(), stage_.motion(), integrator_->scheme(), h_, limits_, horizon);
    add_warnings(cell_, preflight);
    if (preflight.refused.ok()) return true;
    stop(preflight.refused);
    cell_.refused = cell_.step == 0;
    return false;
  }

  StepResult step() {
    const SpringSystem system = stage_.system();
    const double time = static_cast<double>(cell_.step) * h_;
    StepResult result;
    if (stage_.load(*integrator_, time, h_)) {
      result = detector_.system_changed(system, stage_.motion());
      if (!result.ok()) return result;
      supply_of_loads_ = max_or_nan(supply_of_loads_, supply());
    }
    if (is_known_) evidence_.before(system, stage_.motion(), h_);
    result = stage_.step(*integrator_, system, time, h_);
    if (!result.ok()) return detector_.with_witness(result, system, stage_.motion());
    if (is_known_) evidence_.after(stage_.motion());
    detector_.add_work(stage_.new_contact_work());
    return detector_.after_step(system, stage_.motion());
  }

  /// The changes that are due after this step.
  StepResult change(const Horizon& horizon) {
    const std::size_t due = changes_by(cell_.step, steps_in_all, scene_.motion.events.size());
    if (due == changes_) return {};
    for (; changes_ < due; ++changes_) stage_.pass_event();
    integrator_->restart();
    take_up_elements();
    supply_ += supply();
    limits_ = stage_.limits();
    if (!check_before(horizon)) return cell_.diagnosis;
    return detector_.system_changed(stage_.system(), stage_.motion());
  }

  /// The witnesses get the elements of the present interval, or do not judge.
  void take_up_elements() {
    const bool has_elements = scene_.beyond_references.empty();
    evidence_.changed_to(has_elements ? &scene_.motion.network_of(changes_).elements : nullptr);
    const bool is_small = stage_.system().vertex_count() <= largest_dense;
    is_known_ = !scene_.has_contact() && (is_small || !reference::is_costly_to_judge(cell_.integrator));
  }

  /// [J] Kinetic and elastic.
  double energy_now() {
    return kinetic_energy(stage_.system(), stage_.motion().v) + elastic_energy(stage_.system(), stage_.motion().x);
  }

  /// [J] What gravity and forces as they are now give to vertices that fall all the time, and driven ones to springs
  /// that are stretched all the time.
  double supply() {
    const SpringSystem system = stage_.system();
    const Motion motion = stage_.motion();
    const double time = h_ * static_cast<double>(steps_in_all);
    double heaviest = 0.0, obstacles = 0.0, mass = 0.0, sum = 0.0;
    for (const double m : system.mass) heaviest = max_or_nan(heaviest, m);
    if (scene_.frozen)
      for (const SceneObstacle& one : scene_.frozen->file.obstacles)
        obstacles = max_or_nan(obstacles, one.obstacle.velocity.norm());
    std::vector<Vector3d> loads(system.vertex_count(), Vector3d(0, 0, 0));  // [N]
    for (const ForceTerm* term : system.terms)
      if (!term->has_energy()) term->add_forces({motion.x}, loads);
    for (std::size_t i = 0; i < system.vertex_count(); ++i) {
      const Vector3d pull =
          (system.pull.empty() ? Vector3d(0, 0, 0) : system.pull[i]) + system.inverse_mass[i] * loads[i];
      const bool is_driven = system.fixed[i] != 0 || (!system.held_axes.empty() && system.held_axes[i] != 0);
      const double speed = (is_driven ? motion.v[i].norm() : 0.0) + obstacles;
      sum += 0.5 * system.mass[i] * std::pow((system.gravity + pull).norm() * time, 2) +
             heaviest * std::pow(speed * time * limits_.upper, 2);
      has_supply_ = has_supply_ || speed > 0.0 || !pull.isZero(0.0) || !system.gravity.isZero(0.0);
      largest_ = max_or_nan(largest_, motion.x[i].cwiseAbs().maxCoeff());
      mass += system.mass[i];
    }
    mass_ = max_or_nan(mass_, mass);
    return sum;
  }

  void stop(const StepResult& result) {
    diagnose(cell_, result);
    if (cell_.step == 0) return;
    detector_.restore(stage_.motion());
    if (check_finite(stage_.motion().x, stage_.motion().v).ok()) return;
    cell_.outcome = ExtremeOutcome::silent;
    cell_.note = "the state to go back to is not finite";
  }

  void judge(const Horizon& horizon) {
    const PointState end = stage_.state();
    const std::optional<MotionDistance> motion = truth_.distance(end, h_);
    cell_.end = numbers_of(end.x, end.v);
    judge_end(cell_, observe(end, motion), evidence_, motion,
              is_unstable_by_theory(integrator_->scheme(), limits_, h_, horizon));
  }

  ExtremeObservation observe(const PointState& end, const std::optional<MotionDistance>& motion) {
    const auto warned_of = [this](StepCode code) {
      return std::ranges::find(cell_.warnings, to_string(code)) != cell_.warnings.end();
    };
    ExtremeObservation seen{.finite = check_finite(end.x, end.v).ok(),
                            .warned = !cell_.warnings.empty(),
                            .warned_of_instability = warned_of(StepCode::unstable_step)};
    if (!seen.finite) return seen;
    seen.energy_before =
        static_cast<long double>(energy_before_) + static_cast<long double>(supply_) + supply_of_loads_;
    seen.energy_after = energy_now();
    seen.energy_rounding = mass_ * std::pow(64 * std::numeric_limits<double>::epsilon() * limits_.upper * largest_, 2);
    seen.must_live = keeps_moving(integrator_->scheme(), limits_) && !has_supply_ && scene_.motion.events.empty() &&
                     !scene_.has_contact();
    if (!motion) return seen;
    TruthScale scale = truth_scale(integrator_->scheme(), limits_, h_, steps_in_all);
    scale.amplitude = motion->moved;
    scale.size = largest_;
    compare_with_truth(seen, *motion, scale);
    return seen;
  }

  const TradeoffScene& scene_;
  SceneTruth& truth_;
  ExtremeCell& cell_;
  double h_;
  SceneStage stage_;
  std::unique_ptr<Integrator> integrator_;
  StepEvidence evidence_;
  DivergenceDetector detector_;
  StableStep limits_;        // now
  std::size_t changes_ = 0;  // that have taken place
  bool is_known_ = false;    // to the witnesses
  bool has_supply_ = false;
  double energy_before_ = 0.0, supply_ = 0.0, supply_of_loads_ = 0.0;  // [J] the last: of those that change in time
  double largest_ = 0.0, mass_ = 0.0;                                  // [m] of the coordinates, [kg]
};

}  // namespace

std::vector<SceneStep> extreme_steps_of(const TradeoffScene& scene, bool quick) {
  std::vector<SceneStep> steps;
  const double omega = scene.fastest_rate;
  if (scene.frozen && scene.frozen->file.step > 0.0) {
    const double h = scene.frozen->file.step;
    steps.push_back({fmt::format("h of the scene, h omega {:.3g}", h * omega), h});
  }
  if (!(omega > 0.0)) return steps;
  std::size_t count = 0;
  for (const double theta : {0.1, 0.5, 1.0, 1.9, 2.5, 30.0, 1e3, 1e6})
    if (++count % 2 == 0 || !quick) steps.push_back({fmt::format("h omega {:g}", theta), theta / omega});
  return steps;
}

std::vector<ExtremeCase> scene_extreme_cases(const std::shared_ptr<const TradeoffScene>& scene, bool quick) {
  std::vector<ExtremeCase> cases;
  const auto truth = std::make_shared<SceneTruth>(*scene);
  for (const SceneStep& step : extreme_steps_of(*scene, quick))
    for (const IntegratorEntry& entry : integrators()) {
      if (!takes(*scene, entry.name)) continue;
      ExtremeCase which{"scene", scene->name, std::string(entry.name), step.value, {}};
      which.make_run = [which, scene, truth, h = step.h](const MakeIntegrator& make) {
        ExtremeCell cell{which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::ok, {}, 0, {}, ""};
        SceneTrial(*scene, *truth, cell, h, make).run();
        return cell;
      };
      cases.push_back(std::move(which));
    }
  return cases;
}

std::optional<reference::NetworkMotion> motion_in_steps(const TradeoffScene& scene, double h, std::uint64_t steps) {
  const std::size_t changes = scene.motion.events.size();
  if (!scene.beyond_references.empty() || changes >= steps) return {};
  reference::NetworkMotion motion = scene.motion;
  for (std::size_t k = 0; k < changes; ++k) {
    const std::uint64_t after = steps * (k + 1) / (changes + 1);
    motion.events[k].time = h * static_cast<double>(after);
  }
  motion.checkpoints = {h * static_cast<double>(steps)};
  return motion;
}

}  // namespace dartboard
