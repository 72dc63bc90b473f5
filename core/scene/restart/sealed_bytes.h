#pragma once
// Bytes with a seal, which shows that they are ours, whole and unchanged.

#include <string>
#include <string_view>

namespace dartboard {

/// A word, the order of bytes, the number of the format, the length, the bytes, and a hash of all that.
std::string sealed(std::string_view bytes);

/// The bytes in the result of `sealed`; errors name `file`.
///
/// throws  IoError if the word, the order of bytes, the format, the length or the hash differs
std::string_view unsealed(std::string_view whole, const std::string& file);

}  // namespace dartboard
