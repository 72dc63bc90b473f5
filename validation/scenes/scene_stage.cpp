#include "validation/scenes/scene_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/error.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {

SceneStage::SceneStage(const TradeoffScene& scene) {
  if (scene.frozen) {
    frozen_.emplace(*scene.frozen);
    return;
  }
  const reference::SpringNetwork& network = scene.motion.network;
  if (!scene.motion.events.empty()) throw InputError("a network without a body has no events");
  const PointState& start = scene.motion.start;
  for (std::size_t i = 0; i < network.mass.size(); ++i) {
    columns_.add_vertex(network.mass[i], start.x[i], start.v[i], network.fixed[i] != 0);
    columns_.viscosity.back() = network.viscosity * network.mass[i];
  }
  for (const reference::Spring& s : network.springs)
    columns_.add_spring(s.a, s.b, s.stiffness, s.rest_length, s.damping);
  columns_.gravity = network.gravity;
}

SpringSystem SceneStage::system() const { return frozen_ ? frozen_->body().system() : columns_.system(); }

Motion SceneStage::motion() { return frozen_ ? frozen_->body().motion() : columns_.motion(); }

PointState SceneStage::state() const {
  if (frozen_) return {frozen_->body().vertices().position, frozen_->body().vertices().velocity};
  return {columns_.x, columns_.v};
}

PointState SceneStage::state_at(double time) {
  PointState now = state();
  if (frozen_) frozen_->show_drives(time, now.v);
  return now;
}

StableStep SceneStage::limits() {
  return frozen_ ? frozen_->limits() : StableStepEstimate().refresh(system(), motion().x);
}

void SceneStage::pass_event() { frozen_.value().pass(); }

TimedRun run_timed(const TradeoffScene& scene, Integrator& integrator, const RunSetting& setting, const CpuClock& clock,
                   const RunLimits& limits) {
  auto* adaptive = dynamic_cast<AdaptiveIntegrator*>(&integrator);
  if (setting.steps == 0 && !(setting.tolerance > 0.0)) throw InputError("a run needs steps, or a tolerance");
  if (setting.steps == 0 && adaptive == nullptr)
    throw InputError(fmt::format("{} cannot choose its steps", integrator.scheme().name));
  if (setting.steps == 0 && !scene.equal_steps().empty())
    throw InputError(fmt::format("{}: {}", scene.name, scene.equal_steps()));
  const bool keeps_h = setting.timing == EventTiming::end_of_step;
  if (keeps_h && (setting.steps == 0 || setting.steps % scene.motion.checkpoints.size() != 0))
    throw InputError(
        fmt::format("{} steps are no multiple of {} checkpoints", setting.steps, scene.motion.checkpoints.size()));
  // the error of a velocity that belongs to one of a position in an oscillation of a sixteenth of the fastest rate: the
  // motions of these scenes are slower than the fastest they could be
  const Tolerance tolerance{setting.tolerance * scene.edge, setting.tolerance * scene.edge * scene.fastest_rate / 16};

  SceneStage stage(scene);
  TimedRun run;
  const auto parts = static_cast<double>(setting.parts);
  if (setting.steps > 0) run.h = scene.duration / static_cast<double>(setting.steps) / parts;
  integrator.restart();
  integrator.reset_work();

  const std::int64_t start = clock();
  const auto give_up_late = [&] {
    if (run.result.ok() && clock() - start > limits.cpu_ns) {
      run.result.code = StepCode::budget;
      run.result.quantity = "CPU seconds";
      run.result.value = 1e-9 * static_cast<double>(limits.cpu_ns);
    }
  };
  std::uint64_t look_after = 1, since_look = 0;
  std::int64_t last_look = start;
  const auto take = [&](double count, double from, double h) {
    const SpringSystem system = stage.system();
    for (double k = 0; k < count && run.result.ok(); ++k) {
      run.result = stage.step(integrator, system, from + k * h, h);
      if (++since_look < look_after) continue;
      // the clock costs as much as a step of a small scene: look at it about every millisecond
      const std::int64_t now = clock();
      if (now - last_look < 1'000'000) look_after *= 2;
      last_look = now;
      since_look = 0;
      give_up_late();
    }
  };
  // the number of steps up to a time: an excess of 2^-30 of a step is rounding
  const auto steps_to = [](double time, double h) { return std::ceil(time / h - 0x1p-30); };
  double t = 0.0, done = 0.0;  // done: steps, where they keep their length
  const auto go_to = [&](double end) {
    if (end <= t) return;
    if (setting.steps == 0) {
      run.result = adaptive->advance(stage.system(), stage.motion(), end - t, tolerance);
      give_up_late();
    } else if (keeps_h) {
      const double before = std::exchange(done, std::max(done, steps_to(end, run.h)));
      take(done - before, before * run.h, run.h);
    } else {
      // as a simulation does: steps end at multiples of their length, and are divided where something changes
      const double length = parts * run.h;
      const auto take_part = [&](double to) {
        if (to - t > 0x1p-30 * length) take(parts, t, (to - t) / parts);
        t = to;
      };
      if (const double boundary = steps_to(t, length) * length; boundary > t) take_part(std::min(boundary, end));
      if (const double whole = std::floor((end - t) / length + 0x1p-30); whole > 0.0) {
        take(parts * whole, t, run.h);
        t += whole * length;
      }
      take_part(end);
    }
    t = end;
  };
  const auto& events = scene.motion.events;
  std::size_t next_event = 0;
  for (const double checkpoint : scene.motion.checkpoints) {
    if (run.states.size() >= limits.checkpoints) break;
    for (; next_event < events.size() && events[next_event].time < checkpoint && run.result.ok(); ++next_event) {
      go_to(events[next_event].time);
      if (!run.result.ok()) break;
      stage.pass_event();
      integrator.restart();
    }
    if (run.result.ok()) go_to(checkpoint);
    if (!run.result.ok()) break;
    run.states.push_back(stage.state_at(checkpoint));
  }
  run.cpu_ns = clock() - start;
  run.work = integrator.work();
  if (setting.steps == 0 && run.work.steps > 0) run.h = t / static_cast<double>(run.work.steps);
  return run;
}

ForceTimer::ForceTimer(const TradeoffScene& scene, CpuClock clock, std::int64_t batch_ns)
    : stage_(scene), clock_(std::move(clock)), terms_(terms_of(stage_.system())), a_(stage_.motion().x.size()) {
  // doubling until the batch is long enough; its first evaluations warm the caches
  for (batch_ = 1; batch_ < 4096; batch_ *= 2)
    if (measure() * static_cast<double>(batch_) >= static_cast<double>(batch_ns)) break;
}

double ForceTimer::measure() {
  const SpringSystem system = stage_.system();
  const Motion motion = stage_.motion();
  const std::int64_t start = clock_();
  for (std::uint64_t k = 0; k < batch_; ++k) accelerations(system, terms_, motion.x, motion.v, a_);
  return static_cast<double>(clock_() - start) / static_cast<double>(batch_);
}

}  // namespace dartboard
