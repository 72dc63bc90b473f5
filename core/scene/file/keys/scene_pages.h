#pragma once
// The published pages about scene files, made from the table of keys.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace dartboard {

/// The JSON Schema (draft 2020-12) of scene files. It has keys, types, ranges and which keys exclude each other; checks
/// that depend on the mesh or on two values at once are left to the parser.
nlohmann::ordered_json scene_schema();

/// The reference page of scene files, in Markdown.
std::string scene_reference();

/// The section of that page about one object, such as "refine"; for a key such as "events" its rows, and the sections
/// about the objects that are its values.
///
/// throws  InputError for any other name; the message lists the objects
std::string scene_reference(std::string_view object_or_key);

}  // namespace dartboard
