#include "core/meshes/base64.h"

#include <cstdint>

namespace dartboard {
namespace {

/// The six bits of a character, or -1.
int six_bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t group = 0;
  int read = 0, padding = 0;
  for (char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    // of four characters the last one or two may be padding
    if (c == '=' && read >= 2) {
      ++padding;
      group <<= 6;
    } else {
      const int bits = six_bits(c);
      if (bits < 0 || padding != 0) return std::nullopt;
      group = group << 6 | static_cast<std::uint32_t>(bits);
    }
    if (++read < 4) continue;
    for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 0xFF);
    group = 0;
    read = padding = 0;
  }
  if (read != 0) return std::nullopt;
  return bytes;
}

}  // namespace dartboard
