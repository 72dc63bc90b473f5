#include "core/operations/topology_change.h"

namespace dartboard {

void TopologyChange::append(const TopologyChange& later) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(vertices, later.vertices);
  add(edges, later.edges);
  add(faces, later.faces);
  add(removed_vertices, later.removed_vertices);
  add(removed_edges, later.removed_edges);
  add(removed_faces, later.removed_faces);
  add(removed_volumes, later.removed_volumes);
}

}  // namespace dartboard
