#include "core/meshes/text/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace dartboard {
namespace {

constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The letters of every twelve bits.
constexpr auto two_letters = [] {
  std::array<std::array<char, 2>, 4096> all{};
  for (std::size_t bits = 0; bits < all.size(); ++bits) all[bits] = {letters[bits >> 6], letters[bits & 63u]};
  return all;
}();

/// The six bits of each character, or -1.
constexpr auto six_bits = [] {
  std::array<std::int8_t, 256> bits{};
  bits.fill(-1);
  for (std::size_t k = 0; k < 64; ++k) bits[static_cast<unsigned char>(letters[k])] = static_cast<std::int8_t>(k);
  return bits;
}();

std::int32_t bits_of(char c) { return six_bits[static_cast<unsigned char>(c)]; }

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
    const std::int32_t bits = bits_of(c);
    if (bits < 0 || padding != 0) return false;
    group = group << 6 | static_cast<std::uint32_t>(bits);
  }
  for (int k = 0; k < 3; ++k) group_[k] = static_cast<char>(group >> (16 - 8 * k) & 0xFF);
  first_ = 0;
  end_ = static_cast<std::size_t>(3 - padding);
  return true;
}

std::size_t Base64Reader::decode_plain_groups(std::size_t most, char* to) {
  const std::size_t groups = std::min(most, (text_.size() - at_) / 4);
  const char* from = text_.data() + at_;
  std::size_t k = 0;
  for (; k < groups; ++k, from += 4, to += 3) {
    const std::int32_t group =
        bits_of(from[0]) << 18 | bits_of(from[1]) << 12 | bits_of(from[2]) << 6 | bits_of(from[3]);
    if (group < 0) break;  // one of them is -1
    to[0] = static_cast<char>(group >> 16);
    to[1] = static_cast<char>(group >> 8 & 0xFF);
    to[2] = static_cast<char>(group & 0xFF);
  }
  at_ += 4 * k;
  return k;
}

bool Base64Reader::take(std::size_t count, std::string& out) {
  if (count > most_left()) return false;
  std::size_t size = out.size();
  out.resize(size + count);
  for (; count > 0; --count) {
    if (first_ == end_) {
      const std::size_t groups = decode_plain_groups(count / 3, out.data() + size);
      size += 3 * groups;
      count -= 3 * groups;
      if (count == 0) break;
      if (!decode_group()) {
        out.resize(size);
        return false;
      }
    }
    out[size++] = group_[first_++];
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
