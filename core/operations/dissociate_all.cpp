#include "core/operations/dissociate_all.h"

#include "core/operations/dissociate_face.h"

namespace dartboard {

template <class Map>
TopologyChange dissociate_all(Map& map, std::span<const Dart> facets) {
  for (const Dart d : facets) map.require_live(d);
  TopologyChange change;
  for (const Dart d : facets) {
    if constexpr (Map::dimension == 3)
      change.append(dissociate_face(map, d));
    else
      change.append(dissociate_edge(map, d));
  }
  return change;
}

template TopologyChange dissociate_all(Map2&, std::span<const Dart>);
template TopologyChange dissociate_all(Map3&, std::span<const Dart>);
template TopologyChange dissociate_all(TetMap&, std::span<const Dart>);

}  // namespace dartboard
