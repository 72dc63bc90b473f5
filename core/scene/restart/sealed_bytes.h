#pragma once
// Bytes with a seal: what says that they are ours, whole and unchanged.

#include <string>
#include <string_view>

namespace dartboard {

/// A word, the order of bytes, the number of the format, the length, the bytes, and a hash of all that.
std::string sealed(std::string_view bytes);

/// The bytes in what `sealed` returned; `file` is what errors name.
///
/// throws  IoError if there is another word, another order of bytes or format, or another length or hash
std::string_view unsealed(std::string_view whole, const std::string& file);

}  // namespace dartboard
