#include "validation/paper/moves_as_reference.h"

#include "core/mechanics/mass_spring_body.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/runge_kutta_4.h"
#include "reference/schemes/extended_motion.h"
#include "validation/paper/worst_share.h"

namespace dartboard {

double motion_beside_reference(const Mesh& mesh) {
  constexpr int steps = 100;
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.01, .viscosity = 0.5};
  problem.h = 1e-3;
  std::uint32_t lowest = 0;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p)
    if (mesh.points[p].z() < mesh.points[lowest].z()) lowest = p;
  problem.fixed = {lowest};

  auto body = build_body<Map3, Held::by_every_dart>(problem);
  const PointState start = body.state();
  CellArrays arrays;
  arrays.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < steps; ++k) integrator.step(arrays, body, problem.h);

  const auto [end, spread] = reference::witnessed_motion(reference::spring_network(problem), start, problem.h, steps);
  const auto off = reference::distance(reference::extended(body.state()), end);
  WorstShare share;
  share.compare(off.position, 0.0, spreads_allowed * spread.position);
  share.compare(off.velocity, 0.0, spreads_allowed * spread.velocity);
  return share.share();
}

}  // namespace dartboard
