#include "core/operations/remove_volume.h"

#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"

namespace dartboard {

template <class Map>
TopologyChange remove_volume(Map& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  for (const Face face : incident_cells<2>(map, Volume{d})) {
    const Dart outside = map.template alpha<3>(face.dart);
    // from the neighbour's side, so that it is the neighbour that keeps; a face sewn to the same volume has no
    // neighbour
    change.append(dissociate_face(map, outside));
  }
  for (const auto v : incident_cells<0>(map, Volume{d})) change.removed_vertices.push_back(v.dart);
  for (const auto e : incident_cells<1>(map, Volume{d})) change.removed_edges.push_back(e.dart);
  for (const auto f : incident_cells<2>(map, Volume{d})) change.removed_faces.push_back(f.dart);
  change.removed_volumes.push_back(d);
  remove_cell(map, d);
  return change;
}

template TopologyChange remove_volume(Map3&, Dart);
template TopologyChange remove_volume(TetMap&, Dart);

}  // namespace dartboard
