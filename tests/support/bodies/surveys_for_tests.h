#pragma once
// The survey of a scene, and its warnings, before the first step.

#include <string>
#include <vector>

#include "core/scene/file/scene_problem.h"
#include "core/scene/survey/scene_warnings.h"

namespace dartboard {

inline SceneSurvey survey_of(const SceneFile& scene) {
  const Problem problem = make_problem(scene);
  return survey_scene(scene, problem, Simulation(scene, problem));
}

inline std::vector<std::string> warnings_before_run(const SceneFile& scene) {
  return warnings_of(scene, survey_of(scene), Simulation(scene));
}

}  // namespace dartboard
