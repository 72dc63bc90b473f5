#pragma once
// Scenes with one fault each, made from valid ones by the table of keys: a reader has to refuse them where the fault
// is.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "validation/scenes/draw.h"

namespace dartboard {

/// A scene with a fault in a key.
struct BrokenScene {
  nlohmann::ordered_json json;
  std::string path;   // of the key, or of the object that lacks one
  std::string fault;  // "an unknown key", "another type", "a number out of range", "nothing where a key is required"
};

/// One fault in one key of a valid scene, both drawn.
BrokenScene broken_scene(nlohmann::ordered_json scene, Draw& draw);

/// What is wrong about how the scene is refused: it is not, or not by an InputError that names the path. None if it is.
std::optional<std::string> wrong_refusal(const BrokenScene& broken);

}  // namespace dartboard
