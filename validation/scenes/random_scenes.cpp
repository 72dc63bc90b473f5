#include "validation/scenes/random_scenes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/random.h"
#include "core/scene/file/scene_materials.h"
#include "validation/cgal/delaunay_ball.h"
#include "validation/scenes/order_scenes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// Random draws, one after another.
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t number) : random_(seed * 1000003 + number) { random_.next(); }

  double uniform(double low, double high) { return low + (high - low) * 0.5 * (random_.next_signed() + 1.0); }
  double logarithmic(double low, double high) { return low * std::pow(high / low, uniform(0.0, 1.0)); }
  bool happens(double probability) { return uniform(0.0, 1.0) < probability; }
  std::uint32_t below(std::size_t n) { return random_.below(n); }
  Vector3d direction() {
    Vector3d d(0, 0, 0);
    while (!(d.norm() > 0.1)) d = random_.next_in_ball();
    return d.normalized();
  }

 private:
  SplitMix64 random_;
};

Vector3d mean(std::span<const Vector3d> points) {
  Vector3d sum(0, 0, 0);
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Mesh draw_mesh(Draw& draw, const RandomSceneOptions& options, std::string& what) {
  const double points = draw.logarithmic(options.least_points, options.most_points);
  Mesh mesh;
  if (draw.happens(1.0 / 3.0)) {
    mesh = delaunay_ball(static_cast<int>(points), draw.below(1000000));
    for (Vector3d& x : mesh.points) x *= 0.1;
    what += fmt::format("a Delaunay ball of {} points", mesh.points.size());
  } else {
    // two sides, and the third as long as the points allow
    const double edge = std::cbrt(points);
    const int nx = std::max(2, static_cast<int>(edge * draw.uniform(0.6, 1.2))) - 1;
    const int ny = std::max(2, static_cast<int>(edge * draw.uniform(0.6, 1.2))) - 1;
    const int nz = std::clamp(static_cast<int>(points / ((nx + 1) * (ny + 1))), 2, 80) - 1;
    const double jitter = draw.uniform(0.0, 0.3);
    mesh = kuhn_box(nx, ny, nz, 0.02, jitter, draw.below(1000000));
    what += fmt::format("a box of {} x {} x {} cubes, jitter {:.2f}", nx, ny, nz, jitter);
  }
  const Vector3d centre = mean(mesh.points);
  for (Vector3d& x : mesh.points) x -= centre;
  return mesh;
}

std::vector<std::uint32_t> side_of(const Mesh& mesh, const Vector3d& direction) {
  double low = direction.dot(mesh.points[0]), high = low;
  for (const auto& p : mesh.points) {
    low = std::min(low, direction.dot(p));
    high = std::max(high, direction.dot(p));
  }
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    if (direction.dot(mesh.points[i]) < low + 0.15 * (high - low)) points.push_back(i);
  return points;
}

}  // namespace

TradeoffScene random_scene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options) {
  Draw draw(seed, number);
  std::string what;
  TableScene scene{.name = fmt::format("seed {}, scene {}", seed, number), .problem = {}};
  Problem& problem = scene.problem;
  problem.mesh = draw_mesh(draw, options, what);
  problem.material = {.density = 1000.0, .stiffness = draw.logarithmic(1.0, 1e3), .damping = 0.0, .viscosity = 0.0};
  problem.surroundings.gravity.setZero();
  if (draw.happens(0.5)) {
    problem.fixed = side_of(problem.mesh, draw.direction());
    what += ", clamped";
  } else {
    what += ", free";
  }
  const reference::SpringNetwork network = reference::spring_network(problem);
  const double soft_rate = reference::fastest_rate(network, problem.mesh.points);
  const double edge = reference::mean_rest_length(network);
  const double strain = draw.logarithmic(options.least_strain, options.most_strain), slowness = draw.uniform(4.0, 24.0);
  if (draw.happens(0.5)) {
    // gravity moves the body by about an edge within a slow turn
    problem.surroundings.gravity = draw.direction() * (draw.uniform(options.least_sag, options.most_sag) * edge *
                                                       std::pow(soft_rate / slowness, 2));
    what += ", gravity";
  }

  // a stiff inclusion, a cut, or neither
  const double lot = draw.uniform(0.0, 1.0);
  const double contrast = lot < 0.35 ? draw.logarithmic(3.0, 1e4) : 1.0;
  const bool cut = options.cuts && lot >= 0.35 && lot < 0.65;
  const double cut_at = draw.uniform(0.15, 0.85);
  const Vector3d normal = draw.direction();
  Vector3d place(0, 0, 0);
  if (contrast > 1.0) {
    place = centroids(problem.mesh)[draw.below(problem.mesh.cell_count())];
    what += fmt::format(", a tenth of it {:.3g} times stiffer", contrast);
  }
  const double damped = draw.uniform(0.0, 1.0);
  const double ratio = damped < 0.4 ? 0.0 : damped < 0.75 ? draw.logarithmic(1e-3, 0.1) : draw.logarithmic(0.3, 1.5);

  set_off(scene, strain, soft_rate / slowness);
  if (draw.happens(0.4)) {
    const Vector3d spin = draw.direction() * (draw.uniform(0.2, 1.0) * soft_rate / slowness * 0.2);
    if (problem.fixed.empty())
      for (std::size_t i = 0; i < problem.mesh.points.size(); ++i)
        problem.initial_velocity[i] += spin.cross(problem.mesh.points[i]);
    what += problem.fixed.empty() ? ", spinning" : "";
  }
  double rate = soft_rate;
  if (contrast > 1.0) {
    add_inclusion(scene, place, contrast);
    rate = tradeoff_scene({}, scene).fastest_rate;
  }
  set_damping(problem, 2.0 * ratio / rate);
  if (ratio > 0.0) {
    problem.material.viscosity = draw.uniform(0.0, 0.02) * ratio * rate;
    what += fmt::format(", damping ratio {:.2g}", ratio);
  }
  const double a_spring = (ratio > 0.0 ? options.damped_work : 1.0) / static_cast<double>(network.springs.size());
  const double least = std::max(options.least_phase, options.least_work * a_spring);
  const double most = std::clamp(options.most_work * a_spring, least, std::max(options.most_phase, least));
  scene.duration = draw.logarithmic(least, std::max(most, 1.01 * least)) / rate;
  if (cut) {
    add_cut(scene, cut_at * scene.duration, Vector3d(0, 0, 0), normal);
    what += fmt::format(", cut in two at {:.2f} of the time", cut_at);
  }
  return tradeoff_scene(what, scene);
}

}  // namespace dartboard
