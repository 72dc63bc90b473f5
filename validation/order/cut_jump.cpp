#include "validation/order/cut_jump.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/plain/error.h"
#include "core/time/system/energy.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {
namespace {

struct Sums {
  double kinetic, elastic, gravity;
  Eigen::Vector3d momentum, angular;
  double momentum_size = 0.0, angular_size = 0.0;
};

Sums sums_of(SceneStage& stage, const Eigen::Vector3d& centre) {
  const SpringSystem system = stage.system();
  const auto [x, v] = stage.motion();
  Sums sums{kinetic_energy(system, v), elastic_energy(system, x), gravity_energy(system, x), linear_momentum(system, v),
            angular_momentum(system, x, v, centre)};
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.momentum_size += system.mass[i] * v[i].norm();
    sums.angular_size += system.mass[i] * (x[i] - centre).norm() * v[i].norm();
  }
  return sums;
}

Eigen::Vector3d centre_of(SceneStage& stage) {
  const SpringSystem system = stage.system();
  const Motion motion = stage.motion();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    sum += system.mass[i] * motion.x[i];
    mass += system.mass[i];
  }
  return sum / mass;
}

}  // namespace

std::vector<CutJump> cut_jumps(const TradeoffScene& scene, Integrator& integrator, double h) {
  std::vector<CutJump> jumps;
  SceneStage stage(scene);
  double t = 0.0;
  for (const reference::NetworkEvent& event : scene.motion.events) {
    const double steps = std::ceil((event.time - t) / h), step = (event.time - t) / steps;
    integrator.restart();
    for (double s = 0; s < steps; ++s) {
      const StepResult result = stage.step(integrator, stage.system(), t + s * step, step);
      if (!result.ok()) throw SolverError(to_string(result));
    }
    t = event.time;
    const Eigen::Vector3d centre = centre_of(stage);
    const Sums before = sums_of(stage, centre);
    const std::size_t vertices = stage.motion().x.size();
    stage.pass_event();
    const Sums after = sums_of(stage, centre);
    const auto energy = [](const Sums& s) { return s.kinetic + s.elastic + s.gravity; };
    jumps.push_back({t, vertices, stage.motion().x.size(),
                     std::abs(energy(after) - energy(before)) / (before.kinetic + before.elastic),
                     (after.momentum - before.momentum).norm() / before.momentum_size,
                     (after.angular - before.angular).norm() / before.angular_size});
  }
  return jumps;
}

}  // namespace dartboard
