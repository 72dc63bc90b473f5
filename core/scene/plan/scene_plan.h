#pragma once
// The plan of a scene before it runs: what is built, which key requires it, its bytes, and what no key requires.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/body/contact_forecast.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/memory.h"
#include "core/scene/body/needs.h"
#include "core/scene/survey/selection_counts.h"

namespace dartboard {

/// One part that will be built.
struct PlanItem {
  Part part;
  std::string what;       // "48 bytes of mass, position ... by vertex"
  std::string why;        // "/material/damping: 0.05"
  std::size_t bytes = 0;  // as Part says; of the built body (add_bytes)
  std::size_t which = 0;  // event, or kind of force

  std::string_view name() const { return name_of(part, which); }
};

/// One part that will not be built, because no key requires it.
struct LeftOut {
  std::string what, why;
};

/// How often an event will happen, and its effect on the body as far as its key determines it: cells drawn or in a
/// region at rest, faces named or across a plane at rest. The effect of tearing by stress is not known.
struct EventForecast {
  std::uint64_t times = 0;
  double operations = 0.0;  // in all
};

/// The contact expected before anything moves.
struct ContactPlan {
  ExpectedContacts expected;  // the next rates and steps are for depths of its largest share
  double body_rate = 0.0;     // [1/s] an upper bound of the highest frequency of the body alone
  double contact_rate = 0.0;  // [1/s] the contribution of contacts that deep, as a root of a sum of squares
  double body_step = 0.0;     // [s] the longest stable step of the body alone; infinite of an implicit method
  double stable_step = 0.0;   // [s] with such contacts
};

struct ScenePlan {
  std::string map;  // "tetrahedral 3-g-map"; "no map"
  Needs needs;
  CellCounts counts;  // at the start
  std::size_t darts = 0;
  std::uint64_t steps = 0;
  std::vector<EventForecast> events;
  std::optional<ContactPlan> contact;
  std::vector<PlanItem> items;
  std::vector<LeftOut> left_out;
  std::vector<SelectionCount> selections;  // cuts among them, last
  std::vector<std::string> remarks;        // effects of the mesh and the selections that may not be intended
  MemoryReport unplanned;                  // parts with bytes that no item names: empty, if the plan is right

  std::size_t bytes() const;
};

/// Asked of a simulation of the scene that is built, and takes a step that has something to solve.
///
/// throws  InputError as Simulation does
ScenePlan plan_scene(const SceneFile& scene);

/// The times and effects of events, by what they select.
std::vector<EventForecast> forecast_events(const SceneFile& scene, std::span<const SelectionCount> selections,
                                           std::size_t cells);

/// The scene with its events postponed beyond its end: all that it needs is built, and nothing happens. Stress is
/// computed and tears nothing.
SceneFile with_events_held_back(SceneFile scene);

/// The bytes of every part of such a simulation after that step.
///
/// throws  InputError as Simulation does
MemoryReport measured_memory(const SceneFile& scene);

/// Write the bytes found into the items of a plan, and those of parts without an item into `unplanned`.
void add_bytes(ScenePlan& plan, const MemoryReport& found);

}  // namespace dartboard
