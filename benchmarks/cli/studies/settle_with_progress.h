#pragma once
// The choice of a step for an accuracy, at a command line.

#include <optional>

#include "core/scene/file/scene_file.h"
#include "core/scene/settled_accuracy.h"

namespace dartboard {

/// settle_accuracy, with progress on standard error unless it is to be quiet.
std::optional<SettledAccuracy> settle_with_progress(SceneFile& scene, bool quiet);

}  // namespace dartboard
