#include "validation/order/cut_jump.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/error.h"
#include "core/time/system/energy.h"

namespace dartboard {
namespace {

struct Sums {
  double kinetic, elastic, gravity;
  Eigen::Vector3d momentum, angular;
  double momentum_size = 0.0, angular_size = 0.0;
};

Sums sums_of(const TetBody& body, const SpringEndsView& ends, const Eigen::Vector3d& centre) {
  const SpringSystem system = system_of(body, ends);
  const auto& c = body.vertices;
  Sums sums{kinetic_energy(system, c.velocity), elastic_energy(system, c.position), gravity_energy(system, c.position),
            linear_momentum(system, c.velocity), angular_momentum(system, c.position, c.velocity, centre)};
  for (std::size_t i = 0; i < c.size(); ++i) {
    sums.momentum_size += c.mass[i] * c.velocity[i].norm();
    sums.angular_size += c.mass[i] * (c.position[i] - centre).norm() * c.velocity[i].norm();
  }
  return sums;
}

Eigen::Vector3d centre_of(const TetBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    sum += body.vertices.mass[i] * body.vertices.position[i];
    mass += body.vertices.mass[i];
  }
  return sum / mass;
}

}  // namespace

std::vector<CutJump> cut_jumps(const PreparedScene& scene, Integrator& integrator, double h) {
  std::vector<CutJump> jumps;
  TetBody body = scene.body;
  SpringEndsView ends;
  ends.rebuild(body);
  double t = 0.0;
  for (std::size_t k = 0; k < scene.faces.size(); ++k) {
    const double end = scene.motion.events[k].time;
    const double steps = std::ceil((end - t) / h);
    integrator.restart();
    for (double s = 0; s < steps; ++s) {
      const StepResult result =
          integrator.step(system_of(body, ends), {body.vertices.position, body.vertices.velocity}, (end - t) / steps);
      if (!result.ok()) throw SolverError(to_string(result));
    }
    t = end;
    const Eigen::Vector3d centre = centre_of(body);
    const Sums before = sums_of(body, ends, centre);
    const std::size_t vertices = body.vertices.size();
    ends.apply(body, adapt(body, dissociate_all(body.map, std::span<const Dart>(scene.faces[k]))));
    const Sums after = sums_of(body, ends, centre);
    const auto energy = [](const Sums& s) { return s.kinetic + s.elastic + s.gravity; };
    jumps.push_back({t, vertices, body.vertices.size(),
                     std::abs(energy(after) - energy(before)) / (before.kinetic + before.elastic),
                     (after.momentum - before.momentum).norm() / before.momentum_size,
                     (after.angular - before.angular).norm() / before.angular_size});
  }
  return jumps;
}

}  // namespace dartboard
