#pragma once
// JSON as text.

#include <nlohmann/json.hpp>
#include <string>

namespace dartboard {

/// The text of a value, on one line (-1), or indented by so many blanks. It is ASCII: nothing in it acts on a terminal,
/// and bytes that are no UTF-8, as file names may hold, become U+FFFD.
template <class Json>
std::string json_text(const Json& value, int indent = -1) {
  return value.dump(indent, ' ', true, Json::error_handler_t::replace);
}

}  // namespace dartboard
