#pragma once
// Output of the verbs. All of it passes here, so that no string from outside can act on a terminal.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/escape.h"

namespace dartboard {

/// As fmt::print to a stream, but characters other than line breaks that a terminal acts on are spelt out.
template <class... T>
void tell(std::FILE* to, fmt::format_string<T...> format, T&&... arguments) {
  fmt::print(to, "{}", terminal_lines(fmt::format(format, std::forward<T>(arguments)...)));
}

/// Prints to standard output.
template <class... T>
void tell(fmt::format_string<T...> format, T&&... arguments) {
  tell(stdout, format, std::forward<T>(arguments)...);
}

/// A name or a message from outside on one line of what is printed, however long it is.
inline std::string one_line(std::string_view text, std::size_t most = 100) {
  return shortened(terminal_text(text.substr(0, 8 * most)), most);
}

}  // namespace dartboard
