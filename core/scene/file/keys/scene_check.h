#pragma once
// The check of a scene against the table of keys, before anything is made of it.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/file/keys/scene_keys.h"

namespace dartboard {

/// The value with every default filled in, when it is an object of this shape.
///
/// throws  InputError "NAME: /path: what is there; expected ..." for the first key that is unknown, missing, of the
///         wrong type or out of range, and for keys that exclude each other
nlohmann::ordered_json check_and_complete(const nlohmann::ordered_json& value, Shape shape, std::string_view name);

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
///
/// source  optimal string alignment, the restricted distance of Damerau and Levenshtein
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that was meant: nearest by edit distance, case and dashes aside, if that is at most a third of the letters.
std::optional<std::string> nearest_of(std::span<const std::string> words, std::string_view word);

/// A value as an error shows it: on one line, shortened when long.
std::string shown(const nlohmann::ordered_json& value);

}  // namespace dartboard
