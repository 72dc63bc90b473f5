#include "validation/scenes/random_scenes.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/random.h"
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

/// A tenth of the cells, those nearest to one of them.
std::vector<std::uint8_t> inclusion_around(const Mesh& mesh, std::uint32_t cell) {
  std::vector<Vector3d> centre;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    Vector3d sum(0, 0, 0);
    for (const std::uint32_t i : mesh.cell(c)) sum += mesh.points[i];
    centre.push_back(sum / static_cast<double>(mesh.cell(c).size()));
  }
  std::vector<std::uint32_t> order(centre.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t c) { return (centre[c] - centre[cell]).squaredNorm(); });
  std::vector<std::uint8_t> stiff(centre.size(), 0);
  for (std::size_t k = 0; k < centre.size() / 10; ++k) stiff[order[k]] = 1;
  return stiff;
}

}  // namespace

TradeoffScene random_scene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options) {
  Draw draw(seed, number);
  std::string what;
  SpringScene scene{fmt::format("seed {}, scene {}", seed, number), {}, {}, {}, 1.0, 8};
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
  const double soft_rate = reference::fastest_rate(reference::spring_network(problem), problem.mesh.points);
  const double edge = reference::mean_rest_length(reference::spring_network(problem));
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
  std::vector<std::uint8_t> stiff;
  if (contrast > 1.0) {
    stiff = inclusion_around(problem.mesh, draw.below(problem.mesh.cell_count()));
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
  for (std::size_t c = 0; c < stiff.size(); ++c)  // stiff cells start at rest: else they would hold all of the energy
    if (stiff[c])
      for (const std::uint32_t i : problem.mesh.cell(c)) {
        scene.initial_position[i] = problem.mesh.points[i];
        problem.initial_velocity[i].setZero();
      }

  double rate = soft_rate;
  std::size_t springs = 0;
  {
    PreparedScene undamped = prepare(scene);
    if (!stiff.empty()) stiffen(undamped, problem.mesh, stiff, contrast);
    rate = undamped.fastest_rate;
    springs = undamped.motion.network.springs.size();
  }
  problem.material.damping = 2.0 * ratio / rate * problem.material.stiffness;
  if (ratio > 0.0) {
    problem.material.viscosity = draw.uniform(0.0, 0.02) * ratio * rate;
    what += fmt::format(", damping ratio {:.2g}", ratio);
  }
  const double a_spring = (ratio > 0.0 ? options.damped_work : 1.0) / static_cast<double>(springs);
  const double least = std::max(options.least_phase, options.least_work * a_spring);
  const double most = std::clamp(options.most_work * a_spring, least, std::max(options.most_phase, least));
  scene.duration = draw.logarithmic(least, std::max(most, 1.01 * least)) / rate;
  if (cut) {
    scene.events.push_back(plane_cut(cut_at * scene.duration, Vector3d(0, 0, 0), normal));
    what += fmt::format(", cut in two at {:.2f} of the time", cut_at);
  }
  TradeoffScene made = tradeoff_scene(what, scene);
  if (!stiff.empty()) {
    stiffen(*made.body, problem.mesh, stiff, contrast);
    made.motion = made.body->motion;
    made.fastest_rate = made.body->fastest_rate;
  }
  made.what = what;
  return made;
}

}  // namespace dartboard
