#pragma once
// A bar of elements in motion, for tests of integrators.

#include <cmath>
#include <string_view>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard {

/// A bar that spins, bends and is stretched: 36 tetrahedra, free or held at one end.
inline ElementBody bar(Model model, double damping_time = 0.0, bool held = false) {
  ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), model, 2e4, 0.3, 1000.0, damping_time);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const Eigen::Vector3d r = body.rest[i];
    body.x[i] += Eigen::Vector3d(0.1 * r[0], 0.3 * r[0] * r[0], 0.05 * r[1]);
    body.v[i] = Eigen::Vector3d(0.2, -0.1, 0.3) + Eigen::Vector3d(1.0, 2.0, -1.5).cross(r);
    if (held && r[0] < 1e-9) {
      body.fixed[i] = 1;
      body.x[i] = r;
      body.v[i].setZero();
    }
  }
  return body;
}

struct BarOutcome {
  ElementBody body;
  StepResult result;
};
inline BarOutcome run(ElementBody body, std::string_view integrator, double duration, int steps) {
  const auto method = make_integrator(integrator);
  StepResult result;
  for (int k = 0; k < steps && result.ok(); ++k) result = method->step(body.system(), body.motion(), duration / steps);
  return {std::move(body), result};
}
/// The root of the mean square of the distances of vertices.
inline double distance(const ElementBody& a, const ElementBody& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.x.size(); ++i) sum += (a.x[i] - b.x[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.x.size()));
}

}  // namespace dartboard
