#include "core/operations/remove_component.h"

#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/sew.h"

namespace dartboard {
namespace {

/// One dart of each i-cell among `darts`, which are whole cells.
template <int i, class Map>
std::vector<Dart> one_of_each(const Map& map, const std::vector<Dart>& darts) {
  std::vector<Dart> found;
  Mark seen(map);
  for (const Dart d : darts) {
    bool is_new = false;
    for_each_place_of(map, Cell<i>{d}, seen, [&is_new](Dart) { is_new = true; });
    if (is_new) found.push_back(d);
  }
  return found;
}

}  // namespace

template <class Map>
TopologyChange remove_component(Map& map, Dart d) {
  constexpr int n = Map::dimension;
  map.require_live(d);
  const std::vector<Dart> darts = orbit(map, all_involutions(n), d);
  TopologyChange change;
  change.removed_vertices = one_of_each<0>(map, darts);
  change.removed_edges = one_of_each<1>(map, darts);
  change.removed_faces = one_of_each<2>(map, darts);
  if constexpr (n == 3) change.removed_volumes = one_of_each<3>(map, darts);
  const std::vector<Dart> cells = n == 3 ? change.removed_volumes : change.removed_faces;
  for (const Dart e : darts) unsew<n>(map, e);
  for (const Dart cell : cells) remove_cell(map, cell);
  return change;
}

template TopologyChange remove_component(Map2&, Dart);
template TopologyChange remove_component(Map3&, Dart);
template TopologyChange remove_component(TetMap&, Dart);

}  // namespace dartboard
