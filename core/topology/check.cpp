#include "core/topology/check.h"

#include <fmt/format.h>

namespace dartboard {
namespace {

// Whether all six darts of a face of a live tetrahedron satisfy the conditions. Within the tetrahedron they hold by
// construction, and every turn commutes with alpha_0 and alpha_1: what remains is that the opposite face leads back.
bool face_is_valid(const TetTable& table, std::uint32_t face_slot) {
  constexpr std::uint64_t none = std::uint64_t{1} << 40;  // there are six turns: nothing leads back from a seventh
  constexpr std::uint64_t back[8] = {0, 1, 4, 3, 2, 5, none, none};
  const std::uint32_t o = table.opposite(face_slot), slot = o >> 3, turn = o & 7;
  return table.is_live_tetrahedron(slot / 4) && table.opposite(slot) == 8 * std::uint64_t{face_slot} + back[turn];
}

}  // namespace

template <class Map>
std::string check_dart(const Map& map, Dart d) {
  constexpr int n = Map::dimension;
  if (!map.is_live(d)) return fmt::format("{} is dead", to_string(d));
  if constexpr (Map::tetrahedral)
    if (face_is_valid(map.storage(), d.index / 6)) return {};  // the rest finds the words for a violation
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
      const Dart middle = map.is_live(e) ? map.alpha(i, e) : no_dart;  // not checked yet: may be no live dart
      const Dart back = map.is_live(middle) ? map.alpha(j, middle) : no_dart;
      if (back != d)
        return fmt::format("alpha{0} alpha{1} takes {2} to {3} and {3} to {4}: it is not an involution", i, j,
                           to_string(d), to_string(e), to_string(back));
    }
  return {};
}

template <class Map>
std::string check(const Map& map) {
  // the darts of a tetrahedron's face are valid or invalid together, and its own darts describe a violation best
  if constexpr (Map::tetrahedral) {
    const TetTable& table = map.storage();
    const auto faces = static_cast<std::uint32_t>(map.capacity() / 6);
    for (std::uint32_t s = 0; s < faces; ++s) {
      if (!table.is_live_tetrahedron(s / 4) || face_is_valid(table, s)) continue;
      for (std::uint32_t d = 6 * s; d < 6 * s + 6; ++d)
        if (auto violation = check_dart(map, Dart{d}); !violation.empty()) return violation;
    }
    return {};
  }
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
