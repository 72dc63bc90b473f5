#pragma once
// i-cells: the orbits of all involutions but alpha_i.

#include <cstddef>
#include <vector>

#include "core/topology/orbit.h"

namespace dartboard {

template <int i, class Map>
constexpr Involutions cell_orbit() {
  static_assert(0 <= i && i <= Map::dimension);
  return cell_involutions(Map::dimension, i);
}

/// Call f(dart) for every dart of the cell; f may return true to stop.
template <int i, class Map, class F>
bool for_each_dart_of(const Map& map, Cell<i> cell, F&& f) {
  return for_each_dart_of(map, cell_orbit<i, Map>(), cell.dart, f);
}

/// Call f(dart) once for every place `slot<i>` of the cell, with the lowest dart there: a corner of a tetrahedron at a
/// vertex, every dart in general storage. `seen`, a mark of the caller, holds the places visited; nothing is visited
/// if it has those of the cell already.
///
/// cost    O(darts of the cell); a sixth of a full walk around a vertex of tetrahedra
template <int i, class Map, class F>
void for_each_place_of(const Map& map, Cell<i> cell, Mark& seen, F&& f) {
  constexpr Involutions set = cell_orbit<i, Map>();
  if (!seen.set_if_new(detail::representative<Map>(set, cell.dart))) return;
  detail::walk_places(map, set, cell.dart, seen, f);
}

template <int i, class Map>
std::vector<Dart> orbit(const Map& map, Cell<i> cell) {
  return orbit(map, cell_orbit<i, Map>(), cell.dart);
}

/// Whether two darts belong to the same i-cell.
template <int i, class Map>
bool same_cell(const Map& map, Dart a, Dart b) {
  return same_orbit(map, cell_orbit<i, Map>(), a, b);
}

/// The coverage of all i-cells: f(Cell<i>), each by its dart of lowest number, in ascending order.
template <int i, class Map, class F>
void for_each_cell(const Map& map, F&& f) {
  for_each_orbit(map, cell_orbit<i, Map>(), [&](Dart d) { f(Cell<i>{d}); });
}

template <int i, class Map>
std::size_t count_cells(const Map& map) {
  return count_orbits(map, cell_orbit<i, Map>());
}

/// The i-cells incident to a cell of another dimension, each once: they share a dart.
///
/// cost    O(darts of the cell and of the i-cells around it)
template <int i, int j, class Map>
std::vector<Cell<i>> incident_cells(const Map& map, Cell<j> cell) {
  static_assert(i != j);
  std::vector<Cell<i>> found;
  Mark covered(map);
  // Named captures, the constant inside: GCC 12 lays a [&] capture of it out differently in different files.
  for_each_dart_of(map, cell, [&map, &found, &covered](Dart d) {
    constexpr Involutions set = cell_orbit<i, Map>();
    if (!covered.set_if_new(detail::representative<Map>(set, d))) return;
    found.push_back({d});
    detail::walk(map, set, d, covered, [](Dart) {});
  });
  return found;
}

}  // namespace dartboard
