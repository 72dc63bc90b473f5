#pragma once
// The warnings of a run: one list, in words, each with the key that helps.

#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/scene/survey/scene_survey.h"

namespace dartboard {

/// All warnings so far: about the scene before the first step, which its survey has found, and about what happened
/// since.
std::vector<std::string> warnings_of(const SceneFile& scene, const SceneSurvey& survey, const Simulation& simulation);
/// All but that of a step that is too long, for a scene whose step is still to be chosen.
std::vector<std::string> warnings_but_of_step(const SceneFile& scene, const SceneSurvey& survey,
                                              const Simulation& simulation);

/// The step of a run compared with its motions: "0.12 of the longest stable step" for an explicit method, "at most
/// 0.14" of it by the quick bound of a large body; "motions faster than 16 Hz are not resolved" for an implicit one,
/// for which every step is stable.
std::string step_in_words(const Simulation& simulation, const SceneFile& scene);

}  // namespace dartboard
