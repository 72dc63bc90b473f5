#pragma once
// What the parts of a plan take once they are there.

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

/// The scene with its events held back beyond its end: all that it needs is built, and nothing happens. Stress is
/// watched and tears nothing.
SceneFile with_events_held_back(SceneFile scene);

/// The bytes of every part, asked of the built objects after a step that had something to solve.
///
/// throws  InputError as Simulation does
MemoryReport measured_memory(const SceneFile& scene);

/// What there is of the items of a plan, and beside them.
struct MeasuredPlan {
  std::vector<std::size_t> bytes;  // by item
  MemoryReport unplanned;          // parts with bytes that no item plans
};

/// throws  InputError as Simulation does
MeasuredPlan measured_plan(const SceneFile& scene, const ScenePlan& plan);

}  // namespace dartboard
