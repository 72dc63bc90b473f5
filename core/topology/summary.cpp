#include "core/topology/summary.h"

#include "core/topology/cells.h"
#include "core/topology/check.h"

namespace dartboard {

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
  for (int i = 0; i <= n; ++i) {
    s.cells.push_back(count_orbits(map, cell_involutions(n, i)));
    s.euler += (i % 2 == 0 ? 1 : -1) * static_cast<long>(s.cells.back());
  }
  s.components = count_orbits(map, all_involutions(n));
  for_each_cell<n - 1>(map, [&](auto facet) { s.boundary_facets += map.template is_free<n>(facet.dart) ? 1u : 0u; });
  s.orientable = orientation(map).has_value();
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
