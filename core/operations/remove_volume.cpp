#include "core/operations/remove_volume.h"

#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

/// One dart of each i-cell of a volume whose cells belong to no other; of the faces of any tetrahedron.
template <int i, class Map>
void add_cells(const Map& map, Dart d, std::vector<Dart>& darts) {
  if constexpr (Map::tetrahedral) {
    darts.reserve(6);
    const std::uint32_t first = d.index - d.index % 24;
    for (std::uint32_t p = 0; p < 24; ++p)
      if (detail::representative<Map>(cell_orbit<i, Map>(), {first + p}).index == first + p)
        darts.push_back({first + p});
  } else {
    for (const auto cell : incident_cells<i>(map, Volume{d})) darts.push_back(cell.dart);
  }
}

}  // namespace

template <class Map>
TopologyChange remove_volume(Map& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  std::vector<Dart> faces;
  add_cells<2>(map, d, faces);
  // from the neighbour's side, so that the neighbour keeps its embeddings; a face sewn to the same volume has no
  // neighbour
  for (const Dart face : faces) change.append(dissociate_face(map, map.template alpha<3>(face)));
  add_cells<0>(map, d, change.removed_vertices);
  add_cells<1>(map, d, change.removed_edges);
  add_cells<2>(map, d, change.removed_faces);
  change.removed_volumes.push_back(d);
  remove_cell(map, d);
  return change;
}

template TopologyChange remove_volume(Map3&, Dart);
template TopologyChange remove_volume(TetMap&, Dart);

}  // namespace dartboard
