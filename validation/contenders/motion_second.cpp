#include "validation/contenders/motion_second.h"

#include <cmath>

#include "reference/schemes/extended_motion.h"

namespace dartboard {

std::vector<Contender> contenders_for_a_second() {
  return {contender("arrays"), contender("graph"), contender("cgal-attributes")};
}

std::vector<SecondOfMotion> compare_second(const Problem& problem, double seconds, std::span<const Contender> all) {
  const auto steps = static_cast<int>(std::lround(seconds / problem.h));
  const reference::SpringNetwork network = reference::spring_network(problem);
  PointState start{problem.mesh.points, problem.initial_velocity};
  start.v.resize(start.x.size(), Eigen::Vector3d(0, 0, 0));
  const auto [end, spread] = reference::witnessed_motion(network, start, problem.h, steps, 2);
  const double travelled = reference::distance(end, reference::extended(start)).position;

  std::vector<SecondOfMotion> compared;
  for (const Contender& c : all) {
    const auto body = c.make(problem);
    body->step(steps);
    const auto off = reference::distance(reference::extended(body->state()), end);
    const double position_bound = spreads_of_a_second * spread.position,
                 velocity_bound = spreads_of_a_second * spread.velocity;
    compared.push_back({c.id, steps, travelled, off.position, off.velocity, position_bound, velocity_bound,
                        off.position <= position_bound && off.velocity <= velocity_bound});
  }
  return compared;
}

}  // namespace dartboard
