#pragma once
// A parser of JSON as strict as RFC 8259: no comments, no duplicate keys, no numbers that overflow.

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace dartboard {

/// The value of a JSON text; members keep the order of the text.
///
/// throws  InputError "NAME:LINE:COLUMN: ..." for text that is not JSON, and "NAME: /path: ..." for a key that is given
///         twice
nlohmann::ordered_json parse_strict_json(std::string_view text, std::string_view name);

/// `key` as one step of a JSON pointer (RFC 6901): "~" becomes "~0" and "/" becomes "~1".
std::string pointer_step(std::string_view key);

}  // namespace dartboard
