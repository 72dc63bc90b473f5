#pragma once
// Small valid scenes over all keys of the table, drawn from a seed: what meets in them was not thought of together.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/scene/file/keys/scene_keys.h"

namespace dartboard {

/// Scene `number` of a seed, as a user would write it; it does not depend on the others.
///
/// One to three bodies of a few cells of any kind, of any model; regions, attachments, forces and drives in time,
/// obstacles and bodies that touch, sleep, events of every kind, outputs; any integrator and solver. Twelve to forty
/// steps of a tenth to 0.6 of the longest stable step, in which things move by some tenths of an edge. What the reader
/// of scenes refuses is drawn again.
nlohmann::ordered_json drawn_scene(std::uint64_t seed, std::uint64_t number);

/// A key that is never drawn.
struct KeyNotDrawn {
  Shape shape;
  std::string_view name, why;
};
std::span<const KeyNotDrawn> keys_not_drawn();

}  // namespace dartboard
