#pragma once
// A scene may ask for an accuracy: the step is chosen for it, and the integrator where none is named.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

/// What was chosen for a scene, and why.
struct SettledAccuracy {
  double accuracy = 0.0;  // [mean edge lengths] asked for
  std::string integrator;
  bool integrator_named = false;       // by the scene
  double step = 0.0;                   // [s]
  double recommended_step = 0.0;       // [s] before it was fitted to the times of the scene
  double predicted_error = 0.0;        // [mean edge lengths]
  double predicted_s = 0.0;            // [s] of the run
  double pilot_s = 0.0;                // [s] that the choice took
  std::vector<std::string> omissions;  // what it leaves out of consideration
  std::vector<std::string> untried;    // the methods that there was no time to try
};
/// In one line, and a second with the members of the scene that make the choice a fixed one; a third for what was not
/// tried.
std::string to_string(const SettledAccuracy& settled);
void to_json(nlohmann::json& json, const SettledAccuracy& settled);
void from_json(const nlohmann::json& json, SettledAccuracy& settled);

/// The largest step that is at most `largest` [s] and of which the duration is a multiple, and that of all times of
/// events and output if there is one not much shorter.
///
/// pre  duration > 0 and largest > 0
double step_fitting_times(const SceneFile& scene, double largest);

/// Give a scene that asks for an accuracy its step, by `recommend`, which tells whose pilot has run; does nothing to
/// others.
///
/// throws  InputError as scene_of_file, and when no step of the integrator is found to meet the accuracy
std::optional<SettledAccuracy> settle_accuracy(SceneFile& scene, const CpuClock& clock,
                                               const std::function<void(const std::string&)>& tells = {});

}  // namespace dartboard
