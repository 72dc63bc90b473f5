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

/// Write what was found into the items of a plan, and what none of them names beside them.
void add_bytes(ScenePlan& plan, const MemoryReport& found);

}  // namespace dartboard
