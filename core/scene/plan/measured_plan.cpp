#include "core/scene/plan/measured_plan.h"

#include <algorithm>
#include <limits>

#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"

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

MemoryReport measured_memory(const SceneFile& scene) {
  Simulation simulation(with_events_held_back(scene));
  const bool solves = make_integrator(scene.integrator)->scheme().implicit;
  // the first steps from rest may have nothing to solve; a later one has
  constexpr int most_steps = 32;
  for (int k = 0; k < most_steps; ++k) {
    if (simulation.advance()) break;
    if (!solves || simulation.work().solves > 0) break;
  }
  return simulation.memory();
}

void add_bytes(ScenePlan& plan, const MemoryReport& found) {
  for (const MemoryItem& memory : found) {
    const auto item = std::ranges::find_if(plan.items, [&memory](const PlanItem& planned) {
      return planned.part == memory.part && planned.event == memory.event;
    });
    if (item != plan.items.end())
      item->bytes += memory.bytes;
    else if (memory.bytes > 0)
      plan.unplanned.push_back(memory);
  }
}

}  // namespace dartboard
