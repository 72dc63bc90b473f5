#include "validation/contact/hertz.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/nan_maximum.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

constexpr double young = 1e5, poisson = 0.3;                 // [Pa]
constexpr double ball_radius = 1.0, circle = 0.05;           // [m] of the ball, and of the circle that touches
constexpr double way = circle * circle / ball_radius;        // [m] of the ball
constexpr double wide = 60.0 * circle, fine = 1.3 * circle;  // [m]
constexpr double share_of_way = 0.01;                        // the depth that the law needs
constexpr double long_step = 1e3;                            // [s] inertia does not count

/// Distances from the middle.
std::vector<double> graded(int across, double growth) {
  double size = circle / across;
  std::vector<double> at{0.0};
  while (at.back() < fine) at.push_back(at.back() + size);
  while (at.back() < wide) at.push_back(at.back() + (size *= growth));
  return at;
}

double hertz(double d) {
  return 4.0 / 3.0 * young / (1.0 - poisson * poisson) * std::sqrt(ball_radius) * std::pow(d, 1.5);
}

/// A quarter of the block, below z = 0.
Problem quarter(CellKind cells, const std::vector<double>& at) {
  const int n = static_cast<int>(at.size()) - 1;
  Problem problem;
  problem.mesh = cells == CellKind::hexahedron ? hexahedron_box(n, n, n, 1.0) : kuhn_box(n, n, n, 1.0);
  problem.material = {.density = 1.0,
                      .stiffness = 0.0,
                      .damping = 0.0,
                      .viscosity = 0.0,
                      .young = young,
                      .poisson = poisson,
                      .model = Model::neo_hookean};
  problem.surroundings.gravity.setZero();
  const auto place = [&at](double count) { return at[static_cast<std::size_t>(std::lround(count))]; };
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); ++p) {
    Vector3d& x = problem.mesh.points[p];
    x = {place(x[0]), place(x[1]), -place(n - x[2])};
    const int held = (x[0] == 0.0 ? 1 : 0) + (x[1] == 0.0 ? 2 : 0);
    if (x[2] == -at.back())
      problem.fixed.push_back(p);
    else if (held != 0)
      problem.held_axes.push_back({p, static_cast<HeldAxes>(held)});
  }
  return problem;
}

}  // namespace

HertzResult press_ball(const HertzCase& one) {
  const Problem problem = quarter(one.cells, graded(one.across, one.growth));
  BodyNeeds needs = body_needs(problem, false);
  SceneObstacle ball;
  ball.obstacle.shape = Ball{{0, 0, ball_radius - way}, ball_radius};
  ball.law = {.pressure = 1.5 * hertz(way) / (std::numbers::pi * circle * circle),
              .depth = share_of_way * way,
              .exponent = one.exponent};
  needs.obstacles = {ball};
  const auto body = make_simulated_body(problem, needs);
  const auto integrator = make_integrator("backward-euler");

  HertzResult result{.ended = true};
  for (int step = 0; step < 3; ++step)
    result.ended = integrator->step(body->system(), body->motion(), long_step).ok() && result.ended;
  for (const Vector3d& v : body->vertices().velocity)
    result.moved = max_or_nan(result.moved, long_step * v.norm() / way);
  const ContactState state = body->contacts().state_at(body->vertices().position);
  result.contacts = state.contacts;
  result.force = 4.0 * state.force_on[0].z();
  result.depth = state.deepest / way;
  result.closed_form = hertz(way - state.deepest);
  return result;
}

}  // namespace dartboard
