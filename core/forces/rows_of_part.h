#pragma once
// The pieces of a force term at some of its vertices, with numbers of their own.

#include <cstdint>
#include <vector>

#include "core/forces/force_term.h"

namespace dartboard {

/// The numbers of the pieces whose vertices are in the part, ascending; pieces without vertices are left out.
inline std::vector<std::uint32_t> pieces_of_part(const ForceTerm& term, const VertexSubset& part) {
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t k = 0; k < term.size(); ++k)
    if (const ForceTerm::Nodes nodes = term.nodes(k); !nodes.empty() && part.has(nodes[0])) pieces.push_back(k);
  return pieces;
}

/// The rows of these pieces; `nodes_of` returns the vertices of a row, which are renumbered.
template <class Row, class NodesOf>
std::vector<Row> rows_of_part(const std::vector<Row>& rows, const std::vector<std::uint32_t>& pieces,
                              const VertexSubset& part, const NodesOf& nodes_of) {
  std::vector<Row> own;
  own.reserve(pieces.size());
  for (const std::uint32_t k : pieces)
    for (std::uint32_t& node : nodes_of(own.emplace_back(rows[k]))) node = part.number[node];
  return own;
}
/// The rows of these pieces as they are.
template <class Row>
std::vector<Row> rows_of_part(const std::vector<Row>& rows, const std::vector<std::uint32_t>& pieces) {
  std::vector<Row> own;
  own.reserve(pieces.size());
  for (const std::uint32_t k : pieces) own.push_back(rows[k]);
  return own;
}

}  // namespace dartboard
