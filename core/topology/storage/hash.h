#pragma once
// State hashes: equal bits give equal numbers, printed next to every time.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace dartboard {

/// FNV-1a over 8-byte words (the last one padded with zeros), folded after each, 64 bits. Not for adversaries.
class Hash {
 public:
  Hash() = default;
  /// Continues from the value of another hash.
  explicit Hash(std::uint64_t value) : value_(value) {}
  /// pre  T is plain numbers without padding
  template <class T>
  void add(const std::vector<T>& values) {
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  void add_bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    while (size > 0) {
      std::uint64_t word = 0;
      const std::size_t n = size < 8 ? size : 8;
      std::memcpy(&word, p, n);
      value_ = (value_ ^ word) * 0x100000001b3u;
      value_ ^= value_ >> 32;  // a product carries upwards only: without this, two flipped signs cancel
      p += n;
      size -= n;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace dartboard
