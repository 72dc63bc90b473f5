#pragma once
// Scene files as the studies in time see them.

#include <filesystem>
#include <string_view>

#include "core/scene/file/scene_file.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The motion of a scene file: its body, material, gravity, what is fixed, how it moves first, and of its events those
/// that can take place alike in every run.
///
/// A body of tetrahedra keeps the events that happen once and dissociate faces or tear a fan; their faces are fixed
/// beforehand, where they depend on positions by one accurate run up to them. Other bodies become point masses and
/// springs. Whatever is left out stands in `omissions`, and so does what an accurate run has chosen.
///
/// With the step and integrator of the file the motion has the bits of a Simulation, up to the first event left out.
/// throws  InputError for a duration of zero, for damping without stiffness, and as make_problem; SolverError if the
///         motion up to an event cannot be found
TradeoffScene scene_of_file(const SceneFile& file);

/// A scene by its name in the study, or by the path of its file, which ends in ".json".
///
/// throws  as make_tradeoff_scene, read_scene and scene_of_file
TradeoffScene find_scene(std::string_view name_or_file, const std::filesystem::path& meshes);

}  // namespace dartboard
