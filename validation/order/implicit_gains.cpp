#include "validation/order/implicit_gains.h"

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/nan_maximum.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/system/energy.h"
#include "reference/error_norms.h"
#include "validation/scenes/order_scenes.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

ConservedDrift measure_energy_drift(std::uint64_t steps, double h_omega) {
  EnergyMomentum integrator;
  return measure_energy_drift(steps, h_omega, integrator);
}

ConservedDrift measure_energy_drift(std::uint64_t steps, double h_omega, Integrator& integrator) {
  const Material undamped{.density = 1000.0, .stiffness = 50.0, .damping = 0.0, .viscosity = 0.0};
  TableScene scene = smooth_scene(kuhn_box(3, 3, 3, 0.1, 0.2, 3), undamped, 1.0);
  // A fifth of that scene's strain and speed. Steps of h omega = 20 turn tetrahedra inside out in faster motions, and
  // then the equations of a step may have no solution near its start.
  for (std::size_t i = 0; i < scene.initial_position.size(); ++i) {
    scene.initial_position[i] += 0.8 * (scene.problem.mesh.points[i] - scene.initial_position[i]);
    scene.problem.initial_velocity[i] *= 0.2;
  }
  add_cut(scene, 0.5 * scene.duration, {0.15, 0.15, 0.15}, {1.0, 0.25, 0.5});
  const TradeoffScene made = tradeoff_scene({}, scene);
  const double h = h_omega / made.fastest_rate;

  ConservedDrift found;
  found.steps = steps;
  found.h_omega = h_omega;
  SceneStage stage(made);
  const auto energy = [&stage] { return total_energy(stage.system(), stage.motion().x, stage.motion().v); };
  const double start = energy();
  found.vertices_before = found.vertices_after = stage.motion().x.size();
  for (std::uint64_t n = 0; n < steps; ++n) {
    if (n == steps / 2) {
      stage.pass_event();
      integrator.restart();
      found.vertices_after = stage.motion().x.size();
    }
    const StepResult result = integrator.step(stage.system(), stage.motion(), h);
    if (!result.ok()) {
      found.diagnosis = to_string(result);
      break;
    }
    found.drift = max_or_nan(found.drift, std::abs(energy() / start - 1.0));
  }
  return found;
}

KeptFactor compare_kept_factor(std::uint64_t steps, const std::filesystem::path& meshes) {
  const TradeoffScene scene = make_tradeoff_scene("stiff-1e4-damped", meshes);
  KeptFactor found;
  found.steps = steps;
  const auto run = [&](LinearSolver solver, std::uint64_t count) {
    ImplicitOptions options;
    options.solver = solver;
    BackwardEuler integrator(options);
    TimedRun made = run_timed(scene, integrator, {.steps = count}, no_clock);
    if (!made.result.ok() && found.diagnosis.empty()) found.diagnosis = to_string(made.result);
    return made;
  };
  const TimedRun fresh = run(LinearSolver::fresh_factor, steps), kept = run(LinearSolver::kept_factor, steps),
                 finer = run(LinearSolver::kept_factor, 2 * steps);
  found.fresh = fresh.work.factorisations;
  found.kept = kept.work.factorisations;
  if (!found.diagnosis.empty()) return found;
  found.difference = reference::motion_errors(scene.motion, kept.states, fresh.states).x;
  found.step_error = reference::motion_errors(scene.motion, kept.states, finer.states).x;
  return found;
}

}  // namespace dartboard
