#pragma once
// Bytes written as text (RFC 4648), as XML VTK files hold them.

#include <optional>
#include <string>
#include <string_view>

namespace dartboard {

/// Bytes as base64 text, padded.
std::string encode_base64(std::string_view bytes);

/// The bytes of a base64 text, white space aside; nothing when it is malformed. Padding may also stand inside: some
/// writers encode the length of a block and the block itself one after the other.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace dartboard
