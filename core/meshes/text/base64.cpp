#include "core/meshes/text/base64.h"

#include <algorithm>
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

std::string encode_base64(std::string_view bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t given = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < given ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= given ? letters[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

void Base64Reader::skip_blank() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
    ++at_;
}

bool Base64Reader::decode_group() {
  std::uint32_t group = 0;
  int padding = 0;
  for (int read = 0; read < 4; ++read) {
    skip_blank();
    if (at_ == text_.size()) return false;
    const char c = text_[at_++];
    // of four characters the last one or two may be padding
    if (c == '=' && read >= 2) {
      ++padding;
      group <<= 6;
      continue;
    }
    const int bits = six_bits(c);
    if (bits < 0 || padding != 0) return false;
    group = group << 6 | static_cast<std::uint32_t>(bits);
  }
  for (int k = 0; k < 3; ++k) group_[k] = static_cast<char>(group >> (16 - 8 * k) & 0xFF);
  first_ = 0;
  end_ = static_cast<std::size_t>(3 - padding);
  return true;
}

bool Base64Reader::take(std::size_t count, std::string& out) {
  if (count > most_left()) return false;
  out.reserve(out.size() + count);
  for (; count > 0; --count) {
    if (first_ == end_ && !decode_group()) return false;
    out += group_[first_++];
  }
  return true;
}

bool Base64Reader::at_end() {
  skip_blank();
  return first_ == end_ && at_ == text_.size();
}

std::optional<std::string> decode_base64(std::string_view text) {
  Base64Reader reader(text);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  while (!reader.at_end())
    if (!reader.take(1, bytes)) return std::nullopt;
  return bytes;
}

}  // namespace dartboard
