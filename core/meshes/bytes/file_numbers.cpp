#include "core/meshes/bytes/file_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace dartboard {

void FileNumbers::set_binary(bool big_endian) {
  is_binary_ = true;
  big_endian_ = big_endian;
}

void FileNumbers::begin() {
  if (is_binary_) scan_.line_end();
}

std::string_view FileNumbers::take(std::uint64_t size, Wanted wanted) {
  place_ = scan_.place();
  return scan_.bytes(size, wanted);
}

double FileNumbers::real(Scalar type, Wanted wanted) {
  if (!is_binary_) return scan_.real(wanted);
  const double value = real_of(type, take(size_of(type), wanted), big_endian_);
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite", value), wanted.text());
  return value;
}

std::int64_t FileNumbers::integer(Scalar type, Wanted wanted) {
  return is_binary_ ? integer_of(type, take(size_of(type), wanted), big_endian_) : scan_.integer(wanted);
}

std::uint64_t FileNumbers::count(Scalar type, Wanted wanted) {
  const std::int64_t value = integer(type, wanted);
  if (value < 0) fail(fmt::format("{} is negative", value), wanted.text());
  return static_cast<std::uint64_t>(value);
}

void FileNumbers::skip(Scalar type, std::uint64_t many, Wanted wanted) {
  if (!is_binary_) {
    for (std::uint64_t k = 0; k < many; ++k) scan_.token(wanted);
    return;
  }
  constexpr auto most = std::numeric_limits<std::uint64_t>::max();
  take(many > most / size_of(type) ? most : many * size_of(type), wanted);
}

std::size_t FileNumbers::plausible(std::uint64_t declared, std::size_t bytes, std::size_t characters) const {
  return scan_.plausible(declared, is_binary_ ? bytes : characters);
}

void FileNumbers::fail(std::string_view found, std::string_view expected) const {
  if (is_binary_) fail_at_byte(scan_.file(), place_, found, expected);
  scan_.fail(found, expected);
}

}  // namespace dartboard
