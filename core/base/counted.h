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
/// "1 vertex", "2 vertices".
inline std::string counted(std::uint64_t n, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", n, n == 1 ? singular : plural);
}

}  // namespace dartboard
