#include "core/mechanics/adapt.h"

#include <algorithm>
#include <unordered_set>

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;
using Numbers = std::unordered_set<std::uint32_t>;

std::vector<std::uint32_t> sorted(const Numbers& numbers) {
  std::vector<std::uint32_t> list(numbers.begin(), numbers.end());
  std::sort(list.begin(), list.end());
  return list;
}

/// Put the last element in place k and drop the last.
template <class... Column>
void move_last(std::uint32_t k, Column&... columns) {
  ((columns[k] = columns.back(), columns.pop_back()), ...);
}

template <class... Column>
void duplicate(std::uint32_t k, Column&... columns) {
  (columns.push_back(columns[k]), ...);
}

/// Give every part of the cells in `pairs` a number of its own: the first part met keeps the one they share, each
/// further part gets the next, with a copy of the columns. All numbers met end up in `touched`, their lowest darts in
/// `dart_of`.
template <int i, class Map, class Index, class Duplicate>
void separate(const Map& map, Index& index, const std::vector<DissociatedCell>& pairs, std::vector<Dart>& dart_of,
              Numbers& touched, Duplicate&& duplicate_columns) {
  Mark seen(map);
  const auto part = [&](Dart d) {
    if (!map.is_live(d) || seen(d)) return;
    Dart lowest = d;
    for_each_dart_of(map, Cell<i>{d}, [&](Dart e) {
      seen.set(e);
      lowest = std::min(lowest, e);
    });
    std::uint32_t number = index(map, d);
    if (!touched.insert(number).second) {
      duplicate_columns(number);
      number = static_cast<std::uint32_t>(dart_of.size());
      dart_of.push_back(lowest);
      touched.insert(number);
      index.attach(map, Cell<i>{lowest}, number);
    }
    dart_of[number] = lowest;
  };
  for (const DissociatedCell& pair : pairs) part(pair.kept);
  for (const DissociatedCell& pair : pairs) part(pair.split);
}

/// Take the numbers away that only dead darts hold now: those read at `removed` that no live part of a touched cell
/// kept. The last number moves into each gap.
template <int i, class Map, class Index, class Move>
void close_gaps(const Map& map, Index& index, const std::vector<Dart>& removed, std::vector<Dart>& dart_of,
                Numbers& touched, std::vector<Renumbered>& moved, Move&& move_last_columns) {
  Numbers dead;
  for (const Dart d : removed)
    if (const std::uint32_t number = index(map, d); number != no_embedding && !touched.contains(number))
      dead.insert(number);
  const auto ascending = sorted(dead);
  for (auto hole = ascending.rbegin(); hole != ascending.rend();
       ++hole) {  // from the end: the last is never dead itself
    const auto last = static_cast<std::uint32_t>(dart_of.size() - 1);
    touched.erase(last);
    if (*hole != last) {
      index.attach(map, Cell<i>{dart_of[last]}, *hole);
      touched.insert(*hole);
    }
    move_last_columns(*hole);
    move_last(*hole, dart_of);
    moved.push_back({last, *hole});
  }
}

}  // namespace

template <class Map>
ChangedEmbeddings adapt(Body<Map>& body, const TopologyChange& change) {
  constexpr int n = Map::dimension;
  const Map& map = body.map;
  VertexColumns& v = body.vertices;
  Numbers vertices, edges, faces, cells;
  ChangedEmbeddings changed;

  // what came apart
  separate<0>(map, body.vertex, change.vertices, v.dart, vertices, [&](std::uint32_t k) {
    duplicate(k, v.mass, v.inverse_mass, v.viscosity, v.position, v.velocity, v.force, v.fixed, v.point);
  });
  separate<1>(map, body.edge, change.edges, body.edge_dart, edges,
              [&](std::uint32_t k) { duplicate(k, body.springs); });
  if constexpr (n == 3) separate<2>(map, body.face, change.faces, body.face_dart, faces, [](std::uint32_t) {});

  // what went away
  close_gaps<n>(map, body.cell, n == 3 ? change.removed_volumes : change.removed_faces, body.cell_dart, cells,
                changed.moved_cells,
                [&](std::uint32_t k) { move_last(k, body.cell_mass, body.node_share, body.cell_inside_out); });
  if constexpr (n == 3)
    close_gaps<2>(map, body.face, change.removed_faces, body.face_dart, faces, changed.moved_faces,
                  [](std::uint32_t) {});
  close_gaps<1>(map, body.edge, change.removed_edges, body.edge_dart, edges, changed.moved_edges,
                [&](std::uint32_t k) { move_last(k, body.springs); });
  close_gaps<0>(map, body.vertex, change.removed_vertices, v.dart, vertices, changed.moved_vertices,
                [&](std::uint32_t k) {
                  move_last(k, v.mass, v.inverse_mass, v.viscosity, v.position, v.velocity, v.force, v.fixed, v.point);
                });

  // what has other neighbours now
  for (const std::uint32_t k : edges)
    body.springs[k] = body.spring_of(Edge{body.edge_dart[k]}, body.springs[k].rest_length);
  Numbers reweighed = vertices;
  // masses are summed in the order of cell numbers: a renumbered cell can change the last bit of its vertices
  for (const std::uint32_t c : cells)
    for (const Vertex w : incident_cells<0>(map, Cell<n>{body.cell_dart[c]}))
      reweighed.insert(body.vertex(map, w.dart));
  for (const std::uint32_t k : reweighed) body.set_mass(k, body.mass_of(Vertex{v.dart[k]}));
  // the springs around a renumbered vertex have another number at this end
  for (const std::uint32_t k : vertices)
    for (const Edge e : incident_cells<1>(map, Vertex{v.dart[k]})) edges.insert(body.edge(map, e.dart));

  changed.vertices = sorted(vertices);
  changed.edges = sorted(edges);
  changed.faces = sorted(faces);
  changed.cells = sorted(cells);
  changed.vertex_count = v.size();
  changed.edge_count = body.springs.size();
  changed.face_count = body.face_dart.size();
  changed.cell_count = body.cell_mass.size();
  return changed;
}

template ChangedEmbeddings adapt(Body<Map2>&, const TopologyChange&);
template ChangedEmbeddings adapt(Body<Map3>&, const TopologyChange&);
template ChangedEmbeddings adapt(Body<TetMap>&, const TopologyChange&);

}  // namespace dartboard
