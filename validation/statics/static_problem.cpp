#include "validation/statics/static_problem.h"

#include <algorithm>
#include <limits>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "reference/elements/held_solid.h"
#include "validation/statics/linearised.h"
#include "validation/statics/static_rest.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double length = 1.0, side = 0.2;
// [spacings] along each axis; four points of a tetrahedron that move by 0.26 do not flatten it (mesh_generators.h)
constexpr double moved = 0.15;

}  // namespace

StaticProblem loaded_beam(CellKind cells, int across, double traction, bool large) {
  const double spacing = side / across;
  const int along = static_cast<int>(length / side) * across;
  StaticProblem problem{.mesh = cells == CellKind::hexahedron ? hexahedron_box(along, across, across, spacing)
                                                              : kuhn_box(along, across, across, spacing),
                        .force = {},
                        .large = large};
  SplitMix64 random(1);
  const double near = 1e-6 * spacing;
  const Vector3d load = traction * Vector3d(0.0, 0.6, 0.8);
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); ++p) {
    Vector3d& x = problem.mesh.points[p];
    const auto on_side = [&](double c) { return c < near || c > side - near; };
    const bool at_start = x[0]<near, at_end = x[0]> length - near;
    if (at_start) problem.held.push_back(p);
    // each square of the end gives a quarter to each corner
    const double squares = (on_side(x[1]) ? 0.5 : 1.0) * (on_side(x[2]) ? 0.5 : 1.0);
    problem.force.push_back(at_end ? Vector3d(squares * spacing * spacing * load) : Vector3d::Zero());
    if (at_start || at_end || on_side(x[1]) || on_side(x[2])) continue;
    for (double& c : x) c += moved * spacing * random.next_signed();
  }
  return problem;
}

double bends_far(CellKind cells, int across) {
  if (cells == CellKind::hexahedron) return 800.0;
  return across == 2 ? 1700.0 : 1000.0;
}

std::unique_ptr<SimulatedBody> body_of(const StaticProblem& problem, Model model) {
  Problem body_problem;
  body_problem.mesh = problem.mesh;
  body_problem.material = {.stiffness = 0.0,
                           .damping = 0.0,
                           .viscosity = 0.0,
                           .young = problem.young,
                           .poisson = problem.poisson,
                           .model = model};
  body_problem.surroundings.gravity.setZero();
  body_problem.fixed = problem.held;
  return make_simulated_body(body_problem, false);
}

std::vector<Vector3d> forces_on(const StaticProblem& problem, const SimulatedBody& body) {
  std::vector<Vector3d> force;
  for (const std::uint32_t point : body.vertices().point) force.push_back(problem.force[point]);
  return force;
}

std::vector<Vector3d> displacements_by_core(const StaticProblem& problem) {
  const auto body = body_of(problem, Model::stvk);
  const auto& vertices = body->vertices();
  const SpringSystem system = body->system();
  const std::vector<Vector3d> force = forces_on(problem, *body);

  std::vector<Vector3d> u(problem.mesh.points.size(), Vector3d::Zero());
  if (problem.large) {
    const StaticRest rest = static_rest(system, vertices.position, force, {.parts = StaticProblem::parts});
    for (std::size_t k = 0; k < u.size(); ++k) u[vertices.point[k]] = rest.x[k] - vertices.position[k];
  } else {
    Eigen::VectorXd load(static_cast<Eigen::Index>(3 * force.size()));
    for (std::size_t k = 0; k < force.size(); ++k) load.segment<3>(static_cast<Eigen::Index>(3 * k)) = force[k];
    const Eigen::VectorXd bent = linearised(system, vertices.position).displacements(load);
    for (std::size_t k = 0; k < u.size(); ++k) u[vertices.point[k]] = bent.segment<3>(static_cast<Eigen::Index>(3 * k));
  }
  return u;
}

double displacements_apart(std::span<const Vector3d> u, std::span<const Vector3d> truth) {
  if (u.size() != truth.size()) return std::numeric_limits<double>::quiet_NaN();
  double apart = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) apart = max_or_nan(apart, (u[i] - truth[i]).norm());
  return apart / largest_displacement(truth);
}

double largest_displacement(std::span<const Vector3d> u) {
  double largest = 0.0;
  for (const Vector3d& d : u) largest = max_or_nan(largest, d.norm());
  return largest;
}

}  // namespace dartboard
