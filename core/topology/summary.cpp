#include "core/topology/summary.h"

#include "core/base/disjoint_sets.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"

namespace dartboard {

namespace {

/// Of each live tetrahedron, by its number: the sign of its even darts, where alpha_3 changes signs too and the first
/// tetrahedron of a component has +1.
struct TetrahedronSigns {
  std::vector<signed char> sign;
  std::size_t components = 0;
  bool consistent = true;

  explicit TetrahedronSigns(const TetMap& map) : sign(map.capacity() / 24, 0) {
    const TetTable& table = map.storage();
    std::vector<std::uint32_t> stack;
    for (std::uint32_t seed = 0; seed < sign.size(); ++seed) {
      if (!table.is_live_tetrahedron(seed) || sign[seed] != 0) continue;
      ++components;
      sign[seed] = 1;
      stack.assign(1, seed);
      while (!stack.empty()) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        for (std::uint32_t s = 4 * t; s < 4 * t + 4; ++s) {
          const Dart d{6 * s}, e = map.alpha<3>(d);
          if (e == d) continue;
          const auto wanted = static_cast<signed char>((d.index + e.index) % 2 == 0 ? -sign[t] : sign[t]);
          signed char& there = sign[e.index / 24];
          if (there == 0) {
            there = wanted;
            stack.push_back(e.index / 24);
          }
          consistent = consistent && there == wanted;
        }
      }
    }
  }
};

/// The sets of the slots of i-cells, those of dead tetrahedra included, that faces join: the i-cells, i < 2.
template <int i>
std::size_t count_joined_slots(const TetMap& map) {
  DisjointSets slots(map.slot_count<i>());
  const TetTable& table = map.storage();
  for (std::uint32_t s = 0; s < map.slot_count<2>(); ++s) {
    if (!table.is_live_tetrahedron(s / 4) || (table.opposite(s) >> 3) < s) continue;
    for (std::uint32_t d = 6 * s; d < 6 * s + 6; d += 2) slots.join(map.slot<i>({d}), map.slot<i>(map.alpha<3>({d})));
  }
  return slots.count();
}

/// Counts the cells of a tetrahedral map without a walk round each cell.
void count_cells_of(const TetMap& map, MapSummary& s) {
  const std::size_t slots = map.capacity() / 24, live = map.dart_count() / 24, dead = slots - live;
  const TetTable& table = map.storage();
  std::size_t ends = 0;  // faces of one tetrahedron, or sewn to themselves
  for (std::uint32_t f = 0; f < 4 * slots; ++f)
    if (table.is_live_tetrahedron(f / 4)) {
      s.boundary_facets += map.is_free<3>({6 * f}) ? 1u : 0u;
      ends += (table.opposite(f) >> 3) == f ? 1u : 0u;
    }
  s.cells = {count_joined_slots<0>(map) - 4 * dead, count_joined_slots<1>(map) - 6 * dead, (4 * live + ends) / 2, live};
  const TetrahedronSigns signs(map);
  s.components = signs.components;
  s.orientable = signs.consistent;
}

}  // namespace

template <class Map>
Components components(const Map& map) {
  constexpr Involutions all = all_involutions(Map::dimension);
  Components found;
  found.of_dart.resize(map.capacity());
  for_each_orbit(map, all, [&](Dart d) {
    const auto label = static_cast<std::uint32_t>(found.count++);
    for_each_dart_of(map, all, d, [&](Dart e) { found.of_dart[e.index] = label; });
  });
  return found;
}

template <class Map>
std::optional<std::vector<signed char>> orientation(const Map& map) {
  std::vector<signed char> sign(map.capacity(), 0);
  std::vector<Dart> stack;
  bool consistent = true;
  map.for_each_dart([&](Dart seed) {
    if (sign[seed.index] != 0) return;
    sign[seed.index] = 1;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const Dart d = stack.back();
      stack.pop_back();
      for (int i = 0; i <= Map::dimension; ++i) {
        const Dart e = map.alpha(i, d);
        if (e == d) continue;
        if (sign[e.index] == 0) {
          sign[e.index] = static_cast<signed char>(-sign[d.index]);
          stack.push_back(e);
        }
        consistent = consistent && sign[e.index] == -sign[d.index];
      }
    }
  });
  if (!consistent) return std::nullopt;
  return sign;
}

template <class Map>
MapSummary summarize(const Map& map) {
  constexpr int n = Map::dimension;
  MapSummary s;
  s.dimension = n;
  s.violation = check(map);
  s.darts = map.dart_count();
  if (!s.violation.empty()) return s;
  if constexpr (Map::tetrahedral) {
    count_cells_of(map, s);
  } else {
    for (int i = 0; i <= n; ++i) s.cells.push_back(count_orbits(map, cell_involutions(n, i)));
    s.components = count_orbits(map, all_involutions(n));
    for_each_cell<n - 1>(map, [&](auto facet) { s.boundary_facets += map.template is_free<n>(facet.dart) ? 1u : 0u; });
    s.orientable = orientation(map).has_value();
  }
  for (std::size_t i = 0; i <= n; ++i) s.euler += (i % 2 == 0 ? 1 : -1) * static_cast<long>(s.cells[i]);
  return s;
}

template Components components(const Map2&);
template Components components(const Map3&);
template Components components(const TetMap&);
template std::optional<std::vector<signed char>> orientation(const Map2&);
template std::optional<std::vector<signed char>> orientation(const Map3&);
template std::optional<std::vector<signed char>> orientation(const TetMap&);
template MapSummary summarize(const Map2&);
template MapSummary summarize(const Map3&);
template MapSummary summarize(const TetMap&);

}  // namespace dartboard
