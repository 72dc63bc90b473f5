#pragma once
// Small scenes in which bodies touch, for judging contact.

#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Two boxes that fly into each other, spinning; a bar that is cut while it runs together; a stack that comes to rest
/// on a floor. Nothing acts on the first two from outside.
std::vector<SceneFile> contact_scenes();

}  // namespace dartboard
