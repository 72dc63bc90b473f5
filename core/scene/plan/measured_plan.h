#pragma once
// The memory that the parts of a plan take once they are built.

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

/// The scene with its events postponed beyond its end: all that it needs is built, and nothing happens. Stress is
/// computed and tears nothing.
SceneFile with_events_held_back(SceneFile scene);

/// The bytes of every part, reported by the built objects after a step that had something to solve.
///
/// throws  InputError as Simulation does
MemoryReport measured_memory(const SceneFile& scene);

/// Write the bytes found into the items of a plan, and those of parts without an item into `unplanned`.
void add_bytes(ScenePlan& plan, const MemoryReport& found);

}  // namespace dartboard
