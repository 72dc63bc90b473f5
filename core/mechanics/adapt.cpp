#include "core/mechanics/adapt.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <unordered_set>

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;
using Numbers = std::vector<std::uint32_t>;

/// A set of numbers that is usually small.
class NumberSet {
 public:
  bool contains(std::uint32_t k) const {
    return many_.empty() ? std::find(few_.begin(), few_.end(), k) != few_.end() : many_.contains(k);
  }
  /// True if it was not there.
  bool insert(std::uint32_t k) {
    if (contains(k)) return false;
    few_.push_back(k);
    if (!many_.empty())
      many_.insert(k);
    else if (few_.size() > 32)
      many_.insert(few_.begin(), few_.end());
    return true;
  }
  const auto& numbers() const { return few_; }

 private:
  boost::container::small_vector<std::uint32_t, 32> few_;
  std::unordered_set<std::uint32_t> many_;  // the same numbers, once there are many
};

void sort_once(Numbers& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The numbers below `count`, which are still in use, ascending.
template <class List>
Numbers below(std::size_t count, const List& numbers) {
  Numbers list;
  list.reserve(numbers.size());
  for (const std::uint32_t k : numbers)
    if (k < count) list.push_back(k);
  sort_once(list);
  return list;
}

/// One dart for each place of a cell: a single walk around the cell finds them, and they determine its embedding.
using Places = boost::container::small_vector<Dart, 192>;

/// All places of a cell, given by one of its darts; none if `seen` has them already. Places are looked around from in
/// the order in which they are found, so that a look at one does not wait for the memory of the one before.
template <int i, class Map>
void find_places(const Map& map, Dart d, Mark& seen, Places& places) {
  constexpr Involutions set = cell_orbit<i, Map>();
  places.clear();
  const auto add = [&](Dart place) {
    if (seen.set_if_new(place)) places.push_back(place);
  };
  add(detail::representative<Map>(set, d));
  for (std::size_t k = 0; k < places.size(); ++k) detail::leave_block(map, set, places[k], add);
}

/// Visit every part of the cells in `pairs`: those of `kept` first, each part once.
template <int i, class Map, class Visit>
void for_each_part(const Map& map, const std::vector<DissociatedCell>& pairs, Places& places, Visit&& visit) {
  if (pairs.empty()) return;
  Mark seen(map);
  const auto part = [&map, &places, &seen, &visit](Dart d) {
    if (!map.is_live(d)) return;
    find_places<i>(map, d, seen, places);
    if (!places.empty()) visit();
  };
  for (const DissociatedCell& pair : pairs) part(pair.kept);
  for (const DissociatedCell& pair : pairs) part(pair.split);
}

/// Give every part of the cells in `pairs` a number of its own: the first part met keeps the one they share, each
/// further part gets the next, with a copy of the columns. Then follow(number, places, whether the number changed).
template <int i, class Map, class Index, class Duplicate, class FollowPart>
void separate(const Map& map, Index& index, const std::vector<DissociatedCell>& pairs, std::vector<Dart>& dart_of,
              NumberSet& touched, Duplicate&& duplicate_columns, FollowPart&& follow) {
  Places places;
  for_each_part<i>(map, pairs, places, [&] {
    const Dart lowest = *std::min_element(places.begin(), places.end());
    std::uint32_t number = index(map, lowest);
    const bool is_new = !touched.insert(number);
    if (is_new) {
      duplicate_columns(number);
      number = static_cast<std::uint32_t>(dart_of.size());
      dart_of.push_back(lowest);
      touched.insert(number);
      index.attach_places(map, places, number);
    }
    dart_of[number] = lowest;
    follow(number, places, is_new);
  });
}

/// Free the numbers that only dead darts hold now: those read at `removed` that no live part of a touched cell kept.
/// The last number moves into each gap.
template <int i, class Map, class Index, class Move>
void close_gaps(const Map& map, Index& index, const std::vector<Dart>& removed, std::vector<Dart>& dart_of,
                NumberSet& touched, std::vector<Renumbered>& moved, Move&& move_last_columns) {
  Numbers dead;
  for (const Dart d : removed)
    if (const std::uint32_t number = index(map, d); number != no_embedding && !touched.contains(number))
      dead.push_back(number);
  sort_once(dead);
  for (auto hole = dead.rbegin(); hole != dead.rend(); ++hole) {  // from the end: the last is never dead itself
    const auto last = static_cast<std::uint32_t>(dart_of.size() - 1);
    if (*hole != last) {
      index.attach(map, Cell<i>{dart_of[last]}, *hole);
      touched.insert(*hole);
    }
    move_last_columns(*hole);
    dart_of[*hole] = dart_of.back();
    dart_of.pop_back();
    moved.push_back({last, *hole});
  }
}

/// The numbers of the edges at a vertex with these places.
template <class Map>
void add_edges(const Body<Map>& body, const Places& places, Numbers& edges) {
  for (const Dart d : places) {
    edges.push_back(body.edge(body.map, d));
    if constexpr (Map::tetrahedral) {  // one place stands for the three edges of its tetrahedron there
      edges.push_back(body.edge(body.map, body.map.template alpha<1>(d)));
      edges.push_back(body.edge(body.map, body.map.template alpha<2, 1>(d)));
    }
  }
}

}  // namespace

template <class Map>
ChangedEmbeddings adapt(Body<Map>& body, const TopologyChange& change) {
  constexpr int n = Map::dimension;
  const Map& map = body.map;
  VertexColumns& v = body.vertices;
  NumberSet vertices, edges, faces, cells;
  ChangedEmbeddings changed;
  Numbers& edges_at_renumbered = changed.edges;

  if constexpr (n == 3) {
    const auto nothing = [](auto&&...) {};
    separate<2>(map, body.face, change.faces, body.face_dart, faces, nothing, nothing);
    close_gaps<2>(map, body.face, change.removed_faces, body.face_dart, faces, changed.moved_faces, nothing);
  }
  close_gaps<n>(map, body.cell, n == 3 ? change.removed_volumes : change.removed_faces, body.cell_dart, cells,
                changed.moved_cells,
                [&](std::uint32_t k) { move_last_element(body, Body<Map>::embedded_in_cells(), k); });

  separate<1>(
      map, body.edge, change.edges, body.edge_dart, edges,
      [&](std::uint32_t k) { body.springs.push_back(body.springs[k]); },
      [&](std::uint32_t k, const Places& places, bool) {
        body.springs.set(k, body.spring_of({places.data(), places.size()}, body.springs[k].rest_length));
      });
  close_gaps<1>(map, body.edge, change.removed_edges, body.edge_dart, edges, changed.moved_edges, [&](std::uint32_t k) {
    body.springs.set(k, body.springs.back());
    body.springs.pop_back();
  });

  // Vertices last: the springs around a renumbered one have another number at this end, and now they have their own.
  separate<0>(
      map, body.vertex, change.vertices, v.dart, vertices,
      [&](std::uint32_t k) { add_part_of_element(v, VertexColumns::embedded(), k); },
      [&](std::uint32_t k, const Places& places, bool is_new) {
        body.set_mass(k, body.mass_of({places.data(), places.size()}));
        if (is_new) add_edges(body, places, edges_at_renumbered);
      });
  close_gaps<0>(map, body.vertex, change.removed_vertices, v.dart, vertices, changed.moved_vertices,
                [&](std::uint32_t k) { move_last_element(v, VertexColumns::embedded(), k); });
  for (const auto& [from, to] : changed.moved_vertices)
    if (to < v.size()) {
      Places places;
      Mark seen(map);
      find_places<0>(map, v.dart[to], seen, places);
      add_edges(body, places, edges_at_renumbered);
    }

  changed.edges.insert(changed.edges.end(), edges.numbers().begin(), edges.numbers().end());
  changed.vertex_count = v.size();
  changed.edge_count = body.springs.size();
  changed.face_count = body.face_dart.size();
  changed.cell_count = body.cell_mass.size();
  changed.vertices = below(changed.vertex_count, vertices.numbers());
  changed.edges = below(changed.edge_count, changed.edges);
  changed.faces = below(changed.face_count, faces.numbers());
  changed.cells = below(changed.cell_count, cells.numbers());
  return changed;
}

template ChangedEmbeddings adapt(Body<Map2>&, const TopologyChange&);
template ChangedEmbeddings adapt(Body<Map3>&, const TopologyChange&);
template ChangedEmbeddings adapt(Body<TetMap>&, const TopologyChange&);

}  // namespace dartboard
