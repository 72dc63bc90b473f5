#include "validation/elements/cantilever.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <cmath>
#include <map>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/young.h"
#include "core/time/system/energy.h"
#include "core/time/system/tangent.h"
#include "core/time/system/term_tangents.h"
#include "reference/elements/quadratic_solid.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

bool at_start(const Vector3d& x) { return x[0] < 1e-9; }
bool at_end(const Vector3d& x) { return x[0] > cantilever::length - 1e-9; }

Mesh mesh_of(int across, CellKind cells = CellKind::tetrahedron) {
  const double spacing = cantilever::side / across;
  return cells == CellKind::hexahedron ? hexahedron_box(5 * across, across, across, spacing)
                                       : kuhn_box(5 * across, across, across, spacing);
}

Problem problem_of(const Mesh& mesh, Model model, double poisson) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = cantilever::density,
                      .stiffness = model == Model::springs ? mean_stiffness(mesh, cantilever::young) : 0.0,
                      .damping = 0.0,
                      .viscosity = 0.0,
                      .young = cantilever::young,
                      .poisson = poisson,
                      .model = model};
  problem.surroundings.gravity.setZero();
  return problem;
}

CantileverAnswers answers(const reference::HeldSolid& solid, const VectorXd& force) {
  CantileverAnswers a;
  a.nodes = static_cast<std::size_t>(force.size() / 3);
  a.work = force.dot(solid.displacements(force));
  const auto omega = solid.frequencies(a.frequency.size());
  std::copy(omega.begin(), omega.end(), a.frequency.begin());
  return a;
}

using Entries = std::vector<Eigen::Triplet<double>>;

void add_block(Entries& entries, std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      entries.emplace_back(static_cast<int>(3 * a) + r, static_cast<int>(3 * b) + c, block(r, c));
}

/// The stiffness and the masses of a system where it is.
reference::HeldSolid linearised(const SpringSystem& system, std::span<const Vector3d> x) {
  Entries stiffness, mass;
  std::vector<SpringTangent> tangents;
  evaluate_tangents(system, x, Compression::exact, tangents);
  for (std::size_t s = 0; s < tangents.size(); ++s) {
    const auto [a, b] = system.ends[s];
    const Eigen::Matrix3d k = tangents[s].stiffness();
    add_block(stiffness, a, a, k);
    add_block(stiffness, b, b, k);
    add_block(stiffness, a, b, -k);
    add_block(stiffness, b, a, -k);
  }
  for (const ForceTerm* term : system.terms)
    term->for_each_tangent({x}, Compression::exact, [&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
      for (std::size_t a = 0, k = 0; a < n.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b, ++k) {
          add_block(stiffness, n[a], n[b], blocks[k]);
          if (b < a) add_block(stiffness, n[b], n[a], blocks[k].transpose());
        }
    });
  reference::HeldSolid solid;
  for (std::uint32_t i = 0; i < system.vertex_count(); ++i) {
    add_block(mass, i, i, system.mass[i] * Eigen::Matrix3d::Identity());
    if (system.fixed[i]) solid.held.push_back(i);
  }
  const auto unknowns = static_cast<Eigen::Index>(3 * system.vertex_count());
  solid.stiffness.resize(unknowns, unknowns);
  solid.mass.resize(unknowns, unknowns);
  solid.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  solid.mass.setFromTriplets(mass.begin(), mass.end());
  return solid;
}

/// The force on each face of the end, shared equally by its corners, by vertex.
VectorXd end_traction(const SimulatedBody& body, const Mesh& mesh) {
  std::vector<std::uint32_t> vertex_of(mesh.points.size());
  const auto& vertices = body.vertices();
  for (std::uint32_t k = 0; k < vertices.size(); ++k) vertex_of[vertices.point[k]] = k;
  VectorXd force = VectorXd::Zero(static_cast<Eigen::Index>(3 * vertices.size()));
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& face : faces_of(mesh.kinds[c])) {
      const auto point = [&](std::size_t k) { return mesh.cell(c)[static_cast<std::size_t>(face[k])]; };
      const Vector3d &a = mesh.points[point(0)], &b = mesh.points[point(1)], &d = mesh.points[point(2)];
      if (!at_end(a) || !at_end(b) || !at_end(d)) continue;
      // the faces of four corners are squares, two such triangles
      const double area = (b - a).cross(d - a).norm() * (face.size() == 4 ? 1.0 : 0.5);
      for (std::size_t k = 0; k < face.size(); ++k)
        force[3 * static_cast<Eigen::Index>(vertex_of[point(k)]) + 2] += area / static_cast<double>(face.size());
    }
  return force;
}

}  // namespace

CantileverAnswers quadratic_cantilever(int across, double poisson) {
  const reference::QuadraticSolid solid(mesh_of(across), {cantilever::young, poisson, cantilever::density});
  return answers(solid.held_at(solid.nodes_where(at_start)),
                 solid.load(at_end, [](const Vector3d&) { return Vector3d(0, 0, 1.0); }));
}

std::unique_ptr<SimulatedBody> cantilever_body(Model model, int across, double poisson, CellKind cells) {
  Problem problem = problem_of(mesh_of(across, cells), model, poisson);
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); ++p)
    if (at_start(problem.mesh.points[p])) problem.fixed.push_back(p);
  return make_simulated_body(problem, false);
}

CantileverAnswers cantilever_of(Model model, int across, double poisson, CellKind cells) {
  const auto body = cantilever_body(model, across, poisson, cells);
  return answers(linearised(body->system(), body->vertices().position), end_traction(*body, mesh_of(across, cells)));
}

double confined_modulus(double poisson) {
  return cantilever::young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

// The energy of a strain e along x is M e^2 / 2 for each volume; e is small, so that the models' third orders are too.
double confined_modulus_of(Model model, double poisson) {
  const Mesh mesh = kuhn_box(2, 2, 2, 0.5);
  const auto body = make_simulated_body(problem_of(mesh, model, poisson), false);
  constexpr double strain = 1e-4;
  const auto energy = [&](double e) {
    std::vector<Vector3d> x = body->vertices().position;
    for (Vector3d& p : x) p[0] *= 1.0 + e;
    return elastic_energy(body->system(), x);
  };
  return (energy(strain) + energy(-strain)) / (strain * strain);  // of a volume of 1
}

}  // namespace dartboard
