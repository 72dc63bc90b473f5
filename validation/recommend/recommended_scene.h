#pragma once
// A recommendation as a scene: the one way from a pick to what `simulate` runs.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/file/scene_file.h"
#include "reference/error_norms.h"
#include "validation/recommend/recommend.h"
#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// The largest step [s] that is at most `largest` and divides the duration, and the times of output too if there is
/// such a step that is not much shorter. Loads and events divide steps where they need it.
///
/// pre  duration > 0 and largest > 0
double step_fitting_times(const SceneFile& scene, double largest);

/// The setting of a run of a scene, and what is expected of it.
struct FittedPick {
  double step = 0.0;             // [s]
  double predicted_error = 0.0;  // [mean edge lengths]
  double predicted_s = 0.0;      // [s] of the run
};
/// Give a scene that asks for an accuracy the integrator and the step of a pick, fitted to its times.
///
/// pre  the pick has fixed steps
FittedPick fit_pick(SceneFile& scene, const Candidate& pick, const SceneFeatures& features);

/// A scene made for a pick. Its error is that of the pick as long as `trouble` is empty.
struct RecommendedScene {
  nlohmann::ordered_json json;        // paths of meshes are relative to the folder of the scene that it was made from
  SceneFile file;                     // the same, read
  std::uint64_t steps_for_error = 0;  // before they were fitted to the times of the scene
  bool names_cells = false;           // events name the cells that an accurate run has chosen
  std::string choice{};               // a sentence on what its events choose; empty where they choose nothing
  std::string trouble{};              // a sentence on why the run may miss the error; empty if it should not

  std::string setting() const;  // its members that the pick has set, to be pasted into another scene
};

/// The scene of a study with the pick of a recommendation, as `simulate` runs it: its integrator, step, event times.
/// The pick is changed to that step. Where its events would choose other cells than in the accurate run that errors are
/// predicted for, they name those cells instead.
///
/// pre   the scene was made from a file, and there is a pick
/// cost  where events choose by themselves, a run up to the last of them, or two
RecommendedScene recommended_scene(const TradeoffScene& studied, Recommendation& recommendation);

/// Write it into a file, from whose folder the paths of its meshes are found.
///
/// throws  IoError as require_new, and if the file cannot be written
void write_scene(const RecommendedScene& scene, const std::filesystem::path& file);
/// throws  IoError if there is something of that name, or no folder for it
void require_new(const std::filesystem::path& file);

/// The errors of a Simulation of the scene, at those checkpoints of the study that are step boundaries: the last one at
/// least. Infinite where the run fails or its body has been changed otherwise.
reference::MotionErrors errors_of(const RecommendedScene& scene, const TradeoffScene& studied,
                                  const SceneReference& reference);

}  // namespace dartboard
