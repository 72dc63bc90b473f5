#include "core/topology/check.h"

#include <fmt/format.h>

namespace dartboard {

template <class Map>
std::string check_dart(const Map& map, Dart d) {
  constexpr int n = Map::dimension;
  if (!map.is_live(d)) return fmt::format("{} is dead", to_string(d));
  for (int i = 0; i <= n; ++i) {
    const Dart e = map.alpha(i, d);
    if (!map.is_live(e)) return fmt::format("alpha{}({}) = {}, which is dead", i, to_string(d), to_string(e));
    const Dart back = map.alpha(i, e);
    if (back != d)
      return fmt::format("alpha{0}({1}) = {2} but alpha{0}({2}) = {3}: alpha{0} is not an involution", i, to_string(d),
                         to_string(e), to_string(back));
  }
  for (int i = 0; i <= n; ++i)
    for (int j = i + 2; j <= n; ++j) {
      const Dart e = map.alpha(j, map.alpha(i, d));
      const Dart middle = map.is_live(e) ? map.alpha(i, e) : no_dart;  // not looked at yet: may be no live dart
      const Dart back = map.is_live(middle) ? map.alpha(j, middle) : no_dart;
      if (back != d)
        return fmt::format("alpha{0} alpha{1} takes {2} to {3} and {3} to {4}: it is not an involution", i, j,
                           to_string(d), to_string(e), to_string(back));
    }
  return {};
}

template <class Map>
std::string check(const Map& map) {
  std::string violation;
  const auto end = static_cast<std::uint32_t>(map.capacity());
  for (std::uint32_t slot = 0; slot < end && violation.empty(); ++slot)
    if (map.is_live({slot})) violation = check_dart(map, Dart{slot});
  return violation;
}

template std::string check(const Map2&);
template std::string check(const Map3&);
template std::string check(const TetMap&);
template std::string check_dart(const Map2&, Dart);
template std::string check_dart(const Map3&, Dart);
template std::string check_dart(const TetMap&, Dart);

}  // namespace dartboard
