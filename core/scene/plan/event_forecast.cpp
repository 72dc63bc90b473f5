// The effect of a scene's events on a body, as far as their keys and their selections determine it.

#include <algorithm>

#include "core/base/overloads.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/timeline/event_clock.h"

namespace dartboard {
namespace {

/// The number of steps at which an event is due: several times within one step are one.
std::uint64_t count_times(const SceneEvent& event, const SceneFile& scene) {
  const std::uint64_t end = step_of_time(scene.duration, scene.step);
  EventClock clock(event.from, event.until, event.every, scene.step);
  std::uint64_t count = 0, last = EventClock::never;
  for (; clock.next() <= end; clock.advance()) {
    if (clock.next() != last) ++count;
    last = clock.next();
  }
  return count;
}

}  // namespace

std::vector<EventForecast> forecast_events(const SceneFile& scene, std::span<const SelectionCount> selections,
                                           std::size_t cells) {
  std::vector<EventForecast> forecasts;
  auto left = static_cast<double>(cells);
  for (const SceneEvent& event : scene.events) {
    EventForecast f;
    // many times are counted, not enumerated
    constexpr double many = 1e5;
    const double every = event.every ? std::max(*event.every, scene.step) : scene.step;
    if (const double times = (event.until - event.from) / every; times > many)
      f.times = static_cast<std::uint64_t>(times * (1 + 0x1p-50)) + 1;
    else
      f.times = count_times(event, scene);
    const auto times = static_cast<double>(f.times);
    double selected = 0.0;
    for (const SelectionCount& count : selections)
      if (count.path.starts_with(event.action_path())) selected = static_cast<double>(count.selected);
    // a region is empty after the first time
    const auto of_cells = [&](const CellSelection& chosen, double most) {
      return std::min(std::holds_alternative<RandomSelection>(chosen) ? times * selected : selected, most);
    };
    f.operations = std::visit(
        Overloads{[&](const Remove& remove) { return of_cells(remove.cells, left); },
                  [&](const Refine& refine) { return of_cells(refine.cells, static_cast<double>(cells) * times); },
                  [&](const Tear&) { return times; }, [](const TearWhereStressed&) { return 0.0; },
                  [&](const auto&) { return selected; }},
        event.action);
    if (std::holds_alternative<Remove>(event.action)) left -= f.operations;
    forecasts.push_back(f);
  }
  return forecasts;
}

}  // namespace dartboard
