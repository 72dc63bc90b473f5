#pragma once
// Rules between keys of different objects, or that depend on values. Rules about which keys of one object are given
// together are rows of scene_rules() in keys/scene_keys.cpp.

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The parts of a scene after which rules are checked.
enum class ReadUpTo { events, output, expectation };

/// throws  InputError for the first rule that a scene breaks, of those that need the scene up to that part and no more
void require_rules(const SceneFile& scene, ReadUpTo part);

}  // namespace dartboard
