#include "core/scene/measured_plan.h"

#include <algorithm>
#include <limits>

#include "core/scene/simulation.h"

namespace dartboard {

SceneFile with_events_held_back(SceneFile scene) {
  for (SceneEvent& event : scene.events) {
    if (auto* stress = std::get_if<TearWhereStressed>(&event.action)) {
      stress->threshold = std::numeric_limits<double>::max();
      event.from = 0.0;
    } else {
      event.from = event.until = scene.duration + 1e3 * scene.step;
      event.every.reset();
    }
  }
  return scene;
}

std::vector<std::size_t> measured_bytes(const SceneFile& scene, const ScenePlan& plan) {
  Simulation simulation(with_events_held_back(scene));
  // a step at rest has nothing to solve; some steps on there is
  constexpr int most_steps = 32;
  for (int k = 0; k < most_steps; ++k) {
    if (simulation.advance()) break;
    if (!plan.needs.solver || simulation.work().solves > 0) break;
  }
  std::vector<std::size_t> bytes(plan.items.size(), 0);
  for (const MemoryItem& found : simulation.memory()) {
    const auto item = std::ranges::find_if(plan.items, [&found](const PlanItem& planned) {
      return planned.part == found.part && planned.event == found.event;
    });
    const auto place = item == plan.items.end() ? 0 : item - plan.items.begin();
    bytes[static_cast<std::size_t>(place)] += found.bytes;
  }
  return bytes;
}

}  // namespace dartboard
