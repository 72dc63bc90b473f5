#include "core/meshes/text/base64.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace dartboard {
namespace {

/// The letters of every twelve bits.
constexpr auto two_letters = [] {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::array<char, 2>, 4096> all{};
  for (std::size_t bits = 0; bits < all.size(); ++bits) all[bits] = {letters[bits >> 6], letters[bits & 63u]};
  return all;
}();

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
  std::string text;
  append_base64(text, bytes);
  return text;
}

void append_base64(std::string& text, std::string_view bytes) {
  const std::size_t groups = bytes.size() / 3, left = bytes.size() % 3, begin = text.size();
  text.resize(begin + (groups + (left > 0 ? 1 : 0)) * 4);
  char* to = text.data() + begin;
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  const auto encode = [&to](std::uint32_t group) {
    std::memcpy(to, two_letters[group >> 12].data(), 2);
    std::memcpy(to + 2, two_letters[group & 0xFFFu].data(), 2);
    to += 4;
  };
  std::size_t k = 0;
  // two groups of each eight bytes, which are one load
  for (; 3 * k + 8 <= bytes.size(); k += 2, from += 6) {
    std::uint64_t eight = 0;
    for (std::size_t byte = 0; byte < 8; ++byte) eight = eight << 8 | from[byte];
    encode(static_cast<std::uint32_t>(eight >> 40));
    encode(static_cast<std::uint32_t>(eight >> 16) & 0xFFFFFFu);
  }
  for (; k < groups; ++k, from += 3) encode(std::uint32_t{from[0]} << 16 | std::uint32_t{from[1]} << 8 | from[2]);
  if (left == 0) return;
  encode(std::uint32_t{from[0]} << 16 | (left == 2 ? std::uint32_t{from[1]} << 8 : 0u));
  std::memset(to - (3 - left), '=', 3 - left);
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
