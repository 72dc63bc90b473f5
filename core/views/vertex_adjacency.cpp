#include "core/views/vertex_adjacency.h"

#include <algorithm>

namespace dartboard {
namespace {

/// Ordered as the neighbours are.
std::uint64_t key(Neighbour n) { return std::uint64_t{n.vertex} << 32 | n.edge; }

}  // namespace

SlackRows<Neighbour>::Index VertexAdjacency::position(std::uint32_t vertex, Neighbour neighbour) const {
  // a count, because a search by halves mispredicts a branch at each of its steps, and rows are short
  SlackRows<Neighbour>::Index before = 0;
  for (const Neighbour& other : around(vertex)) before += key(other) < key(neighbour);
  return before;
}

void VertexAdjacency::take_out(std::uint32_t edge, const SpringEnds& ends) {
  for (const auto& [here, there] : {ends, SpringEnds{ends[1], ends[0]}})
    rows_.erase(here, position(here, {there, edge}));
}

void VertexAdjacency::put_in(std::uint32_t edge, const SpringEnds& ends) {
  for (const auto& [here, there] : {ends, SpringEnds{ends[1], ends[0]}})
    rows_.insert(here, position(here, {there, edge}), {there, edge});
}

void VertexAdjacency::fill(std::size_t vertex_count) {
  std::vector<SlackRows<Neighbour>::Index> edges_at(vertex_count, 0);
  for (const SpringEnds& ends : ends_.ends)
    for (const std::uint32_t v : ends) ++edges_at[v];
  rows_.clear();
  for (const auto edges : edges_at) rows_.add_row(edges);
  for (std::uint32_t k = 0; k < ends_.ends.size(); ++k) put_in(k, ends_.ends[k]);
}

bool operator==(const VertexAdjacency& a, const VertexAdjacency& b) {
  if (a.vertex_count() != b.vertex_count()) return false;
  for (std::uint32_t v = 0; v < a.vertex_count(); ++v)
    if (const auto here = a.around(v), there = b.around(v);
        !std::equal(here.begin(), here.end(), there.begin(), there.end()))
      return false;
  return a.ends_ == b.ends_;
}

}  // namespace dartboard
