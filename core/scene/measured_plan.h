#pragma once
// What the parts of a plan take once they are there.

#include "core/scene/scene_plan.h"

namespace dartboard {

/// The scene with its events held back beyond its end: all that it needs is built, and nothing happens. Stress is
/// watched and tears nothing.
SceneFile with_events_held_back(SceneFile scene);

/// The bytes of each item of the plan, asked of the built objects after a step that had something to solve. What there
/// is and no item plans is added to the first item, so that it shows.
///
/// throws  InputError as Simulation does
std::vector<std::size_t> measured_bytes(const SceneFile& scene, const ScenePlan& plan);

}  // namespace dartboard
