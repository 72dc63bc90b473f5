#pragma once
// What a run is warned of: one list, in words, each with the key that helps.

#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"

namespace dartboard {

/// All that can be said so far: of the scene before the first step, and of what happened since.
std::vector<std::string> warnings_of(const SceneFile& scene, const Simulation& simulation);

/// How the step of a run compares with what moves in it: "0.12 of the longest stable step" of an explicit method;
/// "motions faster than 16 Hz are not resolved" of an implicit one, for which every step is stable.
std::string step_in_words(const Simulation& simulation, const SceneFile& scene);

}  // namespace dartboard
