#include "validation/elements/clamped_bar.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/young.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/time/system/energy.h"
#include "reference/elements/quadratic_solid.h"
#include "validation/statics/linearised.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::uint64_t jitter_seed = 1;
constexpr double on_grid = 1e-6;  // [spacings] generators place points to rounding

bool at_start(const ClampedBar& bar, const Vector3d& x) { return x[0] < on_grid * bar.spacing; }
bool at_end(const ClampedBar& bar, const Vector3d& x) { return x[0] > bar.length() - on_grid * bar.spacing; }

Mesh mesh_of(const ClampedBar& bar, const BarModel& model, int finer) {
  const auto [nx, ny, nz] = bar.cubes;
  const double spacing = bar.spacing / finer;
  return model.cells == CellKind::hexahedron
             ? hexahedron_box(nx * finer, ny * finer, nz * finer, spacing)
             : kuhn_box(nx * finer, ny * finer, nz * finer, spacing, model.jitter, jitter_seed);
}

/// The force on each face of the end, shared equally by its corners, by vertex.
VectorXd end_traction(const ClampedBar& bar, const SimulatedBody& body, const Mesh& mesh) {
  std::vector<std::uint32_t> vertex_of(mesh.points.size());
  const auto& vertices = body.vertices();
  for (std::uint32_t k = 0; k < vertices.size(); ++k) vertex_of[vertices.point[k]] = k;
  VectorXd force = VectorXd::Zero(static_cast<Eigen::Index>(3 * vertices.size()));
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& face : faces_of(mesh.kinds[c])) {
      const auto point = [&](std::size_t k) { return mesh.cell(c)[static_cast<std::size_t>(face[k])]; };
      const Vector3d &a = mesh.points[point(0)], &b = mesh.points[point(1)], &d = mesh.points[point(2)];
      if (!at_end(bar, a) || !at_end(bar, b) || !at_end(bar, d)) continue;
      // the faces of four corners are squares, two such triangles
      const double area = (b - a).cross(d - a).norm() * (face.size() == 4 ? 1.0 : 0.5);
      for (std::size_t k = 0; k < face.size(); ++k)
        force[3 * static_cast<Eigen::Index>(vertex_of[point(k)]) + 2] += area / static_cast<double>(face.size());
    }
  return force;
}

/// The number of the place at each point.
/// throws  SolverError where there is none
std::vector<std::uint32_t> nodes_at(std::span<const Vector3d> places, std::span<const Vector3d> points, double within) {
  std::vector<std::uint32_t> found;
  for (const Vector3d& point : points) {
    const auto at = std::ranges::find_if(places, [&](const Vector3d& x) { return (x - point).norm() <= within; });
    if (at == places.end()) throw SolverError(fmt::format("no node lies at {}, {}, {}", point[0], point[1], point[2]));
    found.push_back(static_cast<std::uint32_t>(at - places.begin()));
  }
  return found;
}

}  // namespace

std::size_t ClampedBar::nodes(int finer) const {
  std::size_t product = 1;
  for (const int n : cubes) product *= static_cast<std::size_t>(n * finer + 1);
  return product;
}

std::vector<Vector3d> ClampedBar::watched() const {
  std::vector<Vector3d> points;
  for (int i = 1; i <= cubes[0]; ++i)
    for (int j = 0; j <= cubes[1]; ++j)
      for (int k = 0; k <= cubes[2]; ++k)
        if (i == cubes[0] || j == 0 || j == cubes[1] || k == 0 || k == cubes[2])
          points.push_back(spacing * Vector3d(i, j, k));
  return points;
}

std::string in_words(const BarModel& model) {
  const std::string what =
      model.model == Model::springs
          ? "springs"
          : fmt::format("{} {}", name(model.model), model.cells == CellKind::hexahedron ? "hexahedra" : "tetrahedra");
  return model.jitter > 0.0 ? what + ", jittered" : what;
}

BarModel bar_model(const std::string& words) {
  for (const Model model : {Model::springs, Model::neo_hookean, Model::corotational, Model::stvk})
    for (const CellKind cells : {CellKind::tetrahedron, CellKind::hexahedron})
      for (const double jitter : {0.0, 0.2})
        if (const BarModel made{model, cells, jitter}; in_words(made) == words) return made;
  throw InputError(fmt::format("'{}' is no model of a bar; expected \"springs\" or one of elements", words));
}

std::unique_ptr<SimulatedBody> bar_body(const ClampedBar& bar, const BarModel& model, int finer, double poisson) {
  Problem problem;
  problem.mesh = mesh_of(bar, model, finer);
  problem.material = {.density = bar.density,
                      .stiffness = model.model == Model::springs ? mean_stiffness(problem.mesh, bar.young) : 0.0,
                      .damping = 0.0,
                      .viscosity = 0.0,
                      .young = bar.young,
                      .poisson = poisson,
                      .model = model.model};
  problem.surroundings.gravity.setZero();
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); ++p)
    if (at_start(bar, problem.mesh.points[p])) problem.fixed.push_back(p);
  return make_simulated_body(problem, false);
}

LinearBar linear_bar(const ClampedBar& bar, const BarModel& model, int finer, const SimulatedBody& body) {
  const std::span<const Vector3d> x = body.vertices().position;
  return {linearised(body.system(), x), end_traction(bar, body, mesh_of(bar, model, finer)),
          watched_vertices(bar, body)};
}

std::vector<std::uint32_t> watched_vertices(const ClampedBar& bar, const SimulatedBody& body) {
  return nodes_at(body.vertices().position, bar.watched(), on_grid * bar.spacing);
}

LinearBar quadratic_bar(const ClampedBar& bar, int finer, double poisson) {
  const reference::QuadraticSolid solid(mesh_of(bar, {}, finer), {bar.young, poisson, bar.density});
  return {solid.held_at(solid.nodes_where([&](const Vector3d& x) { return at_start(bar, x); })),
          solid.load([&](const Vector3d& x) { return at_end(bar, x); },
                     [](const Vector3d&) { return Vector3d(0, 0, 1.0); }),
          nodes_at(solid.nodes(), bar.watched(), on_grid * bar.spacing)};
}

double confined_modulus(double young, double poisson) {
  return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

// The energy of a strain e along x is M e^2 / 2 for each volume; e is small, so that the models' third orders are too.
double confined_modulus_of(const ClampedBar& bar, const SimulatedBody& body) {
  constexpr double strain = 1e-4;
  const auto energy = [&](double e) {
    std::vector<Vector3d> x = body.vertices().position;
    for (Vector3d& p : x) p[0] *= 1.0 + e;
    return elastic_energy(body.system(), x);
  };
  return (energy(strain) + energy(-strain)) / (strain * strain * bar.volume());
}

}  // namespace dartboard
