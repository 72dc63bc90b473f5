#include "core/scene/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "core/time/energy.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

constexpr double speed_of_light = 299792458.0;  // [m/s]

}  // namespace

struct Simulation::Sums {
  double mass, energy;  // kinetic and elastic
  Eigen::Vector3d momentum;
  double size_of_momentum;  // sum of m |v|
};

std::string to_string(const Divergence& d) {
  return fmt::format("diverged at step {}, t = {:.6g} s: {} of vertex {} is {:.6g}", d.step, d.time, d.quantity,
                     d.vertex, d.value);
}

Simulation::Simulation(const SceneFile& scene)
    : step_(scene.step), step_count_(step_of_time(scene.duration, scene.step)) {
  const Problem problem = make_problem(scene);
  try {
    body_ = make_simulated_body(problem, !scene.events.empty());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: /body: {}", scene.file, error.what()));
  }
  try {
    integrator_ = make_integrator(scene.integrator);
    for (const SceneEvent& event : scene.events)
      events_.push_back(
          {body_->make_ready(event), EventClock(event.from, event.until, event.every, step_),
           !std::holds_alternative<Remove>(event.action) && !std::holds_alternative<Refine>(event.action)});
    happen();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", scene.file, error.what()));
  }
}

Simulation::~Simulation() = default;

std::optional<Divergence> Simulation::advance() {
  const StepResult result = integrator_->step(body_->system(), body_->motion(), step_);
  ++done_;
  if (!result.ok())
    return failure(fmt::format("{} ({})", result.quantity, to_string(result.code)), result.number, result.value);
  if (auto found = diverged()) return found;
  try {
    happen();
  } catch (const SolverError&) {
    return failure("stress", 0, body_->largest_stress());
  }
  return {};
}

void Simulation::happen() {
  std::size_t operations = 0;
  for (Scheduled& scheduled : events_) {
    if (scheduled.clock.next() > done_) continue;
    while (scheduled.clock.next() <= done_) scheduled.clock.advance();
    std::optional<Sums> before;
    if (watch_ && scheduled.dissociates) before = sums();
    const std::size_t made = scheduled.event->apply();
    if (before && made > 0) compare(*before);
    operations += made;
  }
  operations_ += operations;
  if (operations > 0) integrator_->restart();
}

Simulation::Sums Simulation::sums() const {
  const SpringSystem system = body_->system();
  const VertexColumns& v = body_->vertices();
  double size = 0.0;
  for (std::size_t k = 0; k < v.size(); ++k) size += v.mass[k] * v.velocity[k].norm();
  return {body_->mass(), kinetic_energy(system, v.velocity) + elastic_energy(system, v.position),
          linear_momentum(system, v.velocity), size};
}

void Simulation::compare(const Sums& before) {
  const Sums after = sums();
  const auto relative = [](double change, double scale) { return change == 0.0 ? 0.0 : std::abs(change) / scale; };
  ++jumps_.events;
  jumps_.mass = std::max(jumps_.mass, relative(after.mass - before.mass, before.mass));
  jumps_.momentum =
      std::max(jumps_.momentum, relative((after.momentum - before.momentum).norm(), before.size_of_momentum));
  jumps_.energy = std::max(jumps_.energy, relative(after.energy - before.energy, before.energy));
}

std::optional<Divergence> Simulation::diverged() const {
  const VertexColumns& v = body_->vertices();
  for (std::uint32_t k = 0; k < v.size(); ++k) {
    // one comparison each, which a number that is not finite fails
    const double speed2 = v.velocity[k].squaredNorm(), far2 = v.position[k].squaredNorm();
    if (speed2 <= speed_of_light * speed_of_light && std::isfinite(far2)) continue;
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(v.position[k][i])) return failure("position", k, v.position[k][i]);
      if (!std::isfinite(v.velocity[k][i])) return failure("velocity", k, v.velocity[k][i]);
    }
    return std::isfinite(far2) ? failure("speed", k, v.velocity[k].stableNorm())
                               : failure("distance from the origin", k, v.position[k].stableNorm());
  }
  return {};
}

Divergence Simulation::failure(std::string quantity, std::uint32_t vertex, double value) const {
  return {.step = done_, .time = time(), .quantity = std::move(quantity), .vertex = vertex, .value = value};
}

Diagnostics Simulation::diagnostics() const {
  const SpringSystem system = body_->system();
  const VertexColumns& v = body_->vertices();
  Diagnostics d;
  d.time = time();
  d.kinetic = kinetic_energy(system, v.velocity);
  d.elastic = elastic_energy(system, v.position);
  d.gravitational = gravity_energy(system, v.position);
  d.momentum = linear_momentum(system, v.velocity);
  d.angular_momentum = angular_momentum(system, v.position, v.velocity);
  d.mass = body_->mass();
  d.counts = body_->counts();
  d.boundary = body_->boundary();
  d.largest_stress = body_->largest_stress();
  d.operations = operations_;
  return d;
}

Frame Simulation::frame() const {
  Frame frame = body_->frame();
  frame.time = time();
  return frame;
}

}  // namespace dartboard
