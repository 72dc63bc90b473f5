#include "validation/paper/maps/table_of_darts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <set>
#include <vector>

#include "core/topology/cells.h"
#include "core/topology/check.h"

namespace dartboard {
namespace {

/// The table of section 2.1: darts 1 to 10 across.
constexpr std::array<std::array<std::uint32_t, 10>, 3> table{{
    {2, 1, 4, 3, 6, 5, 8, 7, 10, 9},
    {5, 3, 2, 8, 1, 7, 6, 4, 18, 13},
    {1, 2, 20, 19, 5, 6, 7, 8, 9, 10},
}};

Dart dart(std::uint32_t name) { return {name - 1}; }

template <int i>
void link(Map2& map, std::uint32_t a, std::uint32_t b) {
  if (a != b && map.is_free<i>(dart(a))) map.link<i>(dart(a), dart(b));
}

template <int i>
std::set<std::uint32_t> cell(const Map2& map, std::uint32_t name) {
  std::set<std::uint32_t> names;
  for_each_dart_of(map, Cell<i>{dart(name)}, [&](Dart d) { names.insert(d.index + 1); });
  return names;
}

}  // namespace

Map2 map_of_fig_5() {
  Map2 map;
  for (int k = 0; k < 22; ++k) map.add_dart();
  for (std::uint32_t k = 1; k <= 10; ++k) {
    link<0>(map, k, table[0][k - 1]);
    link<1>(map, k, table[1][k - 1]);
    link<2>(map, k, table[2][k - 1]);
  }
  // edges of the triangle and of the face below
  for (const std::uint32_t k : {11u, 13u, 15u, 17u, 19u, 21u}) link<0>(map, k, k + 1);
  link<1>(map, 14, 17);
  link<1>(map, 20, 21);
  link<1>(map, 22, 11);
  link<1>(map, 12, 15);
  link<1>(map, 16, 19);
  // the triangle on one edge of it
  link<2>(map, 13, 12);
  link<2>(map, 14, 11);
  return map;
}

ClaimAnswer is_fig_5(const Map2& map) {
  if (const std::string violation = check(map); !violation.empty()) return {false, violation};
  int links = 0;
  for (std::uint32_t k = 1; k <= 10; ++k)
    for (int i = 0; i < 3; ++i)
      links += map.alpha(i, dart(k)) == dart(table[static_cast<std::size_t>(i)][k - 1]) ? 1 : 0;
  const auto vertex = cell<0>(map, 2), edge = cell<1>(map, 3), face = cell<2>(map, 9);
  const bool cells = vertex == std::set<std::uint32_t>{2, 3, 20, 21} && edge == std::set<std::uint32_t>{3, 4, 19, 20} &&
                     face == std::set<std::uint32_t>{9, 10, 13, 14, 17, 18};
  return {links == 30 && cells, fmt::format("{} of 30 links; vertex {}, edge {}, face {}", links, vertex, edge, face)};
}

}  // namespace dartboard
