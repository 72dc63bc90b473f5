#pragma once
// Numbers of the type and byte order that a file declares.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace dartboard {

enum class Scalar : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr bool is_real(Scalar type) { return type == Scalar::float32 || type == Scalar::float64; }

constexpr std::size_t size_of(Scalar type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// pre  bytes.size() >= sizeof(T)
template <class T>
T load(std::string_view bytes, bool big_endian) {
  std::array<char, sizeof(T)> stored;
  std::memcpy(stored.data(), bytes.data(), sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(stored.begin(), stored.end());
  return std::bit_cast<T>(stored);
}

/// pre  bytes.size() >= size_of(type)
double real_of(Scalar type, std::string_view bytes, bool big_endian);
/// Of an integer type; an integer beyond 63 bits becomes the largest one within.
std::int64_t integer_of(Scalar type, std::string_view bytes, bool big_endian);

}  // namespace dartboard
