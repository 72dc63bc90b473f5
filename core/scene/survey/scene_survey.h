#pragma once
// The survey of a scene that has been built and not yet run: what it is made of, and what a user should know first.

#include <optional>
#include <string>
#include <vector>

#include "core/plain/material.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/simulation.h"
#include "core/scene/survey/bending_stiffness.h"
#include "core/scene/survey/sag.h"
#include "core/scene/survey/selection_counts.h"

namespace dartboard {

struct SceneSurvey {
  std::vector<Model> models;               // of its cells, each once, springs last
  std::vector<SelectionCount> selections;  // at rest, before the first event; cuts come last
  std::vector<StiffBody> stiff_bodies;     // expected to bend much less than they should
  std::vector<Sag> sags;                   // expected to change their height by more than itself
  std::string free_shapes;                 // a warning of free_shapes_of
  std::vector<std::string> notes;          // what is not wrong and takes long: sentences
  std::optional<CoordinatePrecision> coarse_coordinate;
  // the other warnings of Simulation::check_before_run, with the numbers of vertices in the file. That a stable step
  // does not resolve the fastest motions is not one of them: it holds for most sound runs.
  std::vector<StepResult> warnings;
};

/// pre   the problem is that of the scene, and its simulation has taken no step
/// cost  O(cells + springs), O(cells log cells) with cuts of mixed meshes
SceneSurvey survey_scene(const SceneFile& scene, const Problem& problem, const Simulation& simulation);

}  // namespace dartboard
