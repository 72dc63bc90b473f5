#pragma once
// Counts in sentences: a number and its noun.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace dartboard {

/// "1 event", "2 events".
inline std::string counted(std::uint64_t n, std::string_view singular) {
  return fmt::format("{} {}{}", n, singular, n == 1 ? "" : "s");
}

}  // namespace dartboard
