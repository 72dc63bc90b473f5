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
  // a step at rest has nothing to solve; some steps on there is
  constexpr int most_steps = 32;
  for (int k = 0; k < most_steps; ++k) {
    if (simulation.advance()) break;
    if (!solves || simulation.work().solves > 0) break;
  }
  return simulation.memory();
}

MeasuredPlan measured_plan(const SceneFile& scene, const ScenePlan& plan) {
  MeasuredPlan measured{std::vector<std::size_t>(plan.items.size(), 0), {}};
  for (const MemoryItem& found : measured_memory(scene)) {
    const auto item = std::ranges::find_if(plan.items, [&found](const PlanItem& planned) {
      return planned.part == found.part && planned.event == found.event;
    });
    if (item != plan.items.end())
      measured.bytes[static_cast<std::size_t>(item - plan.items.begin())] += found.bytes;
    else if (found.bytes > 0)
      measured.unplanned.push_back(found);
  }
  return measured;
}

}  // namespace dartboard
