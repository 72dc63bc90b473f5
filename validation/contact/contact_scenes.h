#pragma once
// Small scenes in which bodies touch, for judging contact.

#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Two boxes that fly into each other, spinning; a bar that is cut while it runs together; a stack that comes to rest
/// on a floor. None of the first two is acted on from outside.
std::vector<SceneFile> contact_scenes();

}  // namespace dartboard
