#pragma once
// The check of a storage before it grows: its numbers have 32 bits.

#include <cstdint>

namespace dartboard {

[[noreturn]] void throw_no_room(std::uint64_t used, std::uint64_t more, std::uint64_t most, const char* what);

/// pre     used <= most
/// throws  TopologyError if `used` and `more` of `what` together are more than `most`
inline void require_room(std::uint64_t used, std::uint64_t more, std::uint64_t most, const char* what) {
  if (more > most - used) throw_no_room(used, more, most, what);
}

}  // namespace dartboard
