#pragma once
// Small scenes in which bodies touch, for judging contact.

#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Two boxes that fly into each other, spinning; nothing acts on them from outside.
SceneFile scene_of_collision();
/// A bar that is cut while it runs together, as free.
SceneFile scene_of_cut();
/// Both, and a stack that comes to rest on a floor.
std::vector<SceneFile> contact_scenes();

}  // namespace dartboard
