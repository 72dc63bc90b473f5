#include "core/meshes/bytes/scalar.h"

#include <limits>

namespace dartboard {
namespace {

/// Call `use` with the stored value, as its own type.
template <class Use>
auto with_value(Scalar type, std::string_view bytes, bool big_endian, const Use& use) {
  switch (type) {
    case Scalar::int8: return use(load<std::int8_t>(bytes, big_endian));
    case Scalar::uint8: return use(load<std::uint8_t>(bytes, big_endian));
    case Scalar::int16: return use(load<std::int16_t>(bytes, big_endian));
    case Scalar::uint16: return use(load<std::uint16_t>(bytes, big_endian));
    case Scalar::int32: return use(load<std::int32_t>(bytes, big_endian));
    case Scalar::uint32: return use(load<std::uint32_t>(bytes, big_endian));
    case Scalar::int64: return use(load<std::int64_t>(bytes, big_endian));
    case Scalar::uint64: return use(load<std::uint64_t>(bytes, big_endian));
    case Scalar::float32: return use(load<float>(bytes, big_endian));
    case Scalar::float64: break;
  }
  return use(load<double>(bytes, big_endian));
}

}  // namespace

double real_of(Scalar type, std::string_view bytes, bool big_endian) {
  return with_value(type, bytes, big_endian, [](auto value) { return static_cast<double>(value); });
}

std::int64_t integer_of(Scalar type, std::string_view bytes, bool big_endian) {
  return with_value(type, bytes, big_endian, [](auto value) {
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    if constexpr (std::is_floating_point_v<decltype(value)>)
      return std::int64_t{0};
    else if constexpr (std::is_same_v<decltype(value), std::uint64_t>)
      return value > static_cast<std::uint64_t>(most) ? most : static_cast<std::int64_t>(value);
    else
      return static_cast<std::int64_t>(value);
  });
}

}  // namespace dartboard
