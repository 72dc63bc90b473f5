#pragma once
// Scene files as the studies in time see them.

#include <filesystem>
#include <string_view>

#include "core/scene/file/scene_file.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The motion of a scene file, its events frozen (frozen_scene.h): they take place at their exact times and
/// operate on the same cells in every run. `omissions` says what is left out, and what an accurate run has
/// chosen.
///
/// With the step and integrator of the file, and events at step boundaries, the motion has the bits of a Simulation.
/// throws  InputError for a duration of zero, for `sleep`, for damping without stiffness, and as make_problem and
///         freeze; SolverError if the motion up to an event cannot be found
TradeoffScene scene_of_file(const SceneFile& file);

/// A scene by its name in the study, or by the path of its file, which ends in ".json".
///
/// throws  as make_tradeoff_scene, read_scene and scene_of_file
TradeoffScene find_scene(std::string_view name_or_file, const std::filesystem::path& meshes);

}  // namespace dartboard
