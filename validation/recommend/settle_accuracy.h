#pragma once
// The choice of a step for a scene that asks for an accuracy, and of an integrator where it names none.

#include <functional>
#include <optional>
#include <string>

#include "core/scene/file/scene_file.h"
#include "core/scene/settled_accuracy.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

/// Give a scene that asks for an accuracy its step, by `recommend`, which calls `tells` after each pilot with the name
/// of its method; does nothing to others.
///
/// throws  InputError as scene_of_file, and when no step of the integrator is found to meet the accuracy
std::optional<SettledAccuracy> settle_accuracy(SceneFile& scene, const CpuClock& clock,
                                               const std::function<void(const std::string&)>& tells = {});

}  // namespace dartboard
