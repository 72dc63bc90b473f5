#include "validation/scenes/order_scenes.h"

#include <cmath>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/random.h"
#include "reference/spring_network.h"

namespace dartboard {
namespace {

double rate_of(const Problem& problem) {
  return reference::fastest_rate(reference::spring_network(problem), problem.mesh.points);
}

}  // namespace

std::string_view name(OrderCase which) {
  switch (which) {
    case OrderCase::undamped: return "undamped";
    case OrderCase::damped: return "damped";
    case OrderCase::aligned_cut: return "aligned cut";
    case OrderCase::unaligned_cut: return "unaligned cut";
  }
  return "?";
}

void set_off(TableScene& scene, double strain, double rate) {
  const auto& points = scene.problem.mesh.points;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& p : points) centre += p / static_cast<double>(points.size());
  const double edge = reference::mean_rest_length(reference::spring_network(scene.problem));
  Eigen::Matrix3d field, speed;
  field << 1.0, 0.25, 0.0, -0.25, -0.5, 0.25, 0.0, 0.125, 0.5;
  speed << -0.5, 0.5, 0.0, 0.25, 1.0, -0.25, 0.125, 0.0, -0.75;
  SplitMix64 random(5);
  scene.initial_position.clear();
  scene.problem.initial_velocity.clear();
  for (const auto& p : points) {
    scene.initial_position.push_back(p + strain * (field * (p - centre) + 0.1 * edge * random.next_in_ball()));
    scene.problem.initial_velocity.push_back(strain * rate *
                                             (speed * (p - centre) + 0.1 * edge * random.next_in_ball()));
  }
  for (const std::uint32_t i : scene.problem.fixed) {
    scene.initial_position[i] = points[i];
    scene.problem.initial_velocity[i].setZero();
  }
}

TableScene order_scene(OrderCase which) {
  TableScene scene{.name = std::string(name(which)), .problem = {}, .checkpoints = 4};
  Problem& problem = scene.problem;
  problem.mesh = kuhn_box(3, 3, 3, 0.1, 0.2, 3);
  for (auto& p : problem.mesh.points) p -= Eigen::Vector3d(0.15, 0.15, 0.15);  // small coordinates round less
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.0, .viscosity = 0.0};
  problem.surroundings.gravity = {0, 0.25, -0.5};
  problem.fixed = {0, 1, 2, 3};  // an edge of the box
  const double omega = rate_of(problem);
  if (which == OrderCase::damped) {
    problem.material.damping = 0.2 / omega * problem.material.stiffness;  // c = 2 zeta k / omega
    problem.material.viscosity = 0.02 * omega;
  }
  scene.duration = 16.5 / omega;
  set_off(scene, 0.15, omega / 2);
  const Eigen::Vector3d middle(0, 0, 0), normal(1, 0.25, 0);
  const double time = scene.duration * (which == OrderCase::aligned_cut ? 0.375 : 7.0 / 18.0);
  if (which == OrderCase::aligned_cut || which == OrderCase::unaligned_cut) add_cut(scene, time, middle, normal);
  if (which == OrderCase::aligned_cut)
    scene.events.push_back({Tear{42u, Eigen::Vector3d(0, 0, 1)}, time, time, {}, "/events/1"});
  return scene;
}

TableScene smooth_scene(Mesh mesh, const Material& material, double phase) {
  TableScene scene{.name = "smooth", .problem = {}};
  scene.problem.mesh = std::move(mesh);
  scene.problem.material = material;
  scene.problem.material.damping = scene.problem.material.viscosity = 0.0;
  scene.problem.surroundings.gravity.setZero();
  const double omega = rate_of(scene.problem);
  scene.duration = phase / omega;
  set_off(scene, 0.05, omega / 16);
  return scene;
}

}  // namespace dartboard
