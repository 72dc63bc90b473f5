#pragma once
// The adaptation of embeddings to a topological change (sections 3.2 and 4.3).

#include <cstdint>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/operations/topology_change.h"

namespace dartboard {

/// Embedding `from`, the last of its kind, took the number `to` of a removed one.
struct Renumbered {
  std::uint32_t from, to;
};

/// What a view needs to follow a change: the numbers whose embedding, dart or neighbours have changed, ascending, each
/// once; and the counts of embeddings after the change.
struct ChangedEmbeddings {
  std::vector<std::uint32_t> vertices, edges, faces, cells;  // no faces in a surface, where they are the cells
  // Columns by number that are kept elsewhere follow in this way: make room for new numbers, then do these moves in
  // order, each followed by dropping the last element.
  std::vector<Renumbered> moved_vertices, moved_edges, moved_faces, moved_cells;
  std::size_t vertex_count = 0, edge_count = 0, face_count = 0, cell_count = 0;

  /// The moves of a column by cell number that has no new numbers.
  template <class Column>
  void move_cells(Column& column) const {
    for (const auto& [from, to] : moved_cells) {
      column[to] = column[from];
      column.pop_back();
    }
  }
};

/// Adapt the embeddings of a body to the change that an operation, or a series of them, made to its map.
///
/// Each embedding follows by its own rule: position and velocity are duplicated; mass, eq. (1), and stiffness are
/// computed anew from the incident cells on the rest shape, so that m = m1 + m2 and k = k1 + k2; viscosity is
/// proportional to the mass; rest length is duplicated. One part of a dissociated cell keeps its number, the others get
/// the next free ones. Numbers stay dense: when a cell is removed, the last one takes its number.
///
/// pre     every dart holds the embedding numbers; `change` covers all that happened to the map since the last call,
///         and the slots of removed darts have not been used again
/// cost    O(darts of the touched cells), whatever the size of the body
template <class Map>
ChangedEmbeddings adapt(MassSpringBody<Map, Held::by_every_dart>& body, const TopologyChange& change);

extern template ChangedEmbeddings adapt(MassSpringBody<Map2, Held::by_every_dart>&, const TopologyChange&);
extern template ChangedEmbeddings adapt(MassSpringBody<Map3, Held::by_every_dart>&, const TopologyChange&);
extern template ChangedEmbeddings adapt(MassSpringBody<TetMap, Held::by_every_dart>&, const TopologyChange&);

}  // namespace dartboard
