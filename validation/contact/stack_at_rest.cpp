#include "validation/contact/stack_at_rest.h"

#include <algorithm>
#include <vector>

#include "core/plain/nan_maximum.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

constexpr double edge = 0.05;                            // [m] of a cell
constexpr std::uint64_t falls = 12'000, rests = 10'000;  // steps

constexpr const char* five_boxes =
    R"({"name": "stack of five", "step": 0.00015, "duration": 3.3, "integrator": "verlet",
  "bodies": [
    {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}, "translate": [0, 0, 0.002]},
    {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "kind": "hexahedra"}}, "translate": [0.003, 0.002, 0.104]},
    {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}, "translate": [0, 0.004, 0.206]},
    {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "kind": "hexahedra"}}, "translate": [0.003, 0, 0.308]},
    {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}, "translate": [0, 0.002, 0.41]}],
  "material": {"density": 1000, "young": 1000000, "poisson": 0.3, "viscosity": 20},
  "contact": {"pressure": 100000, "depth": 0.002, "bodies": "others", "restitution": 0.3, "friction": 0.4,
              "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]}})";

}  // namespace

StackAtRest watch_stack() {
  const SceneFile scene = parse_scene(five_boxes, "scene of a stack", "");
  Simulation simulation(scene);
  StackAtRest result{.boxes = scene.bodies().size(), .steps = rests};
  const double start = simulation.diagnostics().gravitational;
  while (simulation.steps_done() < falls)
    if (simulation.advance()) return result;
  result.drop = start - simulation.diagnostics().gravitational;
  const std::vector<Eigen::Vector3d> from = simulation.body().vertices().position;
  constexpr std::uint64_t looks = 100;
  for (std::uint64_t look = 1; look <= looks; ++look) {
    while (simulation.steps_done() < falls + look * (rests / looks))
      if (simulation.advance()) return result;
    result.kinetic = max_or_nan(result.kinetic, simulation.diagnostics().kinetic);
    const auto& x = simulation.body().vertices().position;
    for (std::size_t k = 0; k < x.size(); ++k) result.moved = max_or_nan(result.moved, (x[k] - from[k]).norm() / edge);
  }
  result.ended = true;
  return result;
}

}  // namespace dartboard
