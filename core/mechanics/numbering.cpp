#include "core/mechanics/numbering.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/mechanics/curve_order.h"

namespace dartboard {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// The numbers of cells by ascending darts.
Numbers by_darts(const std::vector<Dart>& dart_of) {
  Numbers order(dart_of.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&dart_of](std::uint32_t k) { return dart_of[k].index; });
  return order;
}

Numbers inverse_of(const Numbers& order) {
  Numbers place(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  return place;
}

template <class Column>
void reorder(Column& column, const Numbers& order) {
  if (column.empty()) return;
  Column sorted;
  sorted.reserve(column.size());
  for (const std::uint32_t k : order) sorted.push_back(column[k]);
  column.swap(sorted);
}

template <class Map, class Embedding>
void reattach(const Map& map, Embedding& embedding, const Numbers& new_number) {
  Embedding fresh;
  map.for_each_dart([&](Dart d) { fresh.attach_places(map, std::span(&d, 1), new_number[embedding(map, d)]); });
  embedding = std::move(fresh);
}

}  // namespace

template <class Map>
std::vector<std::uint32_t> renumber(MassSpringBody<Map, Held::by_every_dart>& body) {
  VertexColumns& v = body.vertices;
  const Numbers vertices = by_darts(v.dart), edges = by_darts(body.edge_dart);
  Numbers number_of_vertex = inverse_of(vertices);

  reattach(body.map, body.vertex, number_of_vertex);
  for_each_column(v, VertexColumns::embedded(), [&vertices](auto& column, const auto&) { reorder(column, vertices); });
  reorder(v.dart, vertices);

  reattach(body.map, body.edge, inverse_of(edges));
  const Springs springs = body.springs;
  for (std::uint32_t k = 0; k < edges.size(); ++k) body.springs.set(k, springs[edges[k]]);
  reorder(body.edge_dart, edges);
  return number_of_vertex;
}

template <class Map>
std::vector<std::uint32_t> Numbering::follow(MassSpringBody<Map, Held::by_every_dart>& body,
                                             const ChangedEmbeddings& changed) {
  // one number for each new embedding, and one for each that has filled a gap
  scattered_vertices_ += changed.vertex_count + 2 * changed.moved_vertices.size() - vertices_;
  scattered_edges_ += changed.edge_count + 2 * changed.moved_edges.size() - edges_;
  vertices_ = changed.vertex_count;
  edges_ = changed.edge_count;
  const auto share = [](std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, all));
  };
  // an edge has two vertices
  const double springs = share(scattered_edges_, edges_) + 2.0 * share(scattered_vertices_, vertices_);
  if (vertices_ <= near_vertices || springs <= most_scattered) return {};
  scattered_vertices_ = scattered_edges_ = 0;
  return renumber(body);
}

DARTBOARD_NUMBERING(, Map2)
DARTBOARD_NUMBERING(, Map3)
DARTBOARD_NUMBERING(, TetMap)

}  // namespace dartboard
