#include "core/operations/remove_face.h"

#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"

namespace dartboard {

TopologyChange remove_face(Map2& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  for (const Edge edge : incident_cells<1>(map, Face{d})) {
    const Dart outside = map.alpha<2>(edge.dart);
    // from the neighbour's side, so that the neighbour keeps its embeddings; an edge within one face has no neighbour
    change.append(dissociate_edge(map, outside));
  }
  for (const auto v : incident_cells<0>(map, Face{d})) change.removed_vertices.push_back(v.dart);
  for (const auto e : incident_cells<1>(map, Face{d})) change.removed_edges.push_back(e.dart);
  change.removed_faces.push_back(d);
  remove_cell(map, d);
  return change;
}

}  // namespace dartboard
