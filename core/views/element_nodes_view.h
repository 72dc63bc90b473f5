#pragma once
// The corners of every element, by cell number: all that elements need to know of the topology.

#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/mechanics/element_nodes.h"

namespace dartboard {

/// One row of corners per cell, in one stream: TetrahedronNodes, sixteen bytes, TriangleNodes, twelve, or SolidNodes.
/// It is empty for a body that has neither such elements nor springs within its cells; on request it has the cells of a
/// body of springs too, whose stress is per present volume.
template <class Nodes>
class ElementNodesView {
 public:
  ElementNodesView() = default;
  explicit ElementNodesView(bool of_springs) : of_springs_(of_springs) {}

  std::vector<Nodes> nodes;
  friend bool operator==(const ElementNodesView&, const ElementNodesView&) = default;

  /// cost    O(cells)
  template <class Body>
  void rebuild(const Body& body) {
    nodes.resize(row_count(body));
    if constexpr (has_nodes<Body>)
      for (std::uint32_t c = 0; c < nodes.size(); ++c) find_nodes(body, c, nodes[c]);
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed cells, and the cells around changed vertices), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    nodes.resize(row_count(body));
    if constexpr (has_nodes<Body>)
      if (!nodes.empty()) follow(body, changed);
  }

  template <class Archive>
  void state(Archive& archive) {
    archive(nodes);
  }

 private:
  template <class Body>
  static constexpr bool has_nodes = std::is_same_v<Nodes, SolidNodes> ||
                                    (Body::dimension == 3) == std::is_same_v<Nodes, TetrahedronNodes>;

  template <class Body>
  std::size_t row_count(const Body& body) const {
    const bool every_cell = of_springs_ && !body.cell_materials().has_elements();
    return every_cell ? body.cell_dart.size() : element_count(body, Nodes{});
  }

  template <class Body>
  void follow(const Body& body, const ChangedEmbeddings& changed) {
    for (const std::uint32_t c : changed.cells) find_nodes(body, c, nodes[c]);
    Mark seen(body.map);
    for (const std::uint32_t k : changed.vertices)
      for_each_place_of(body.map, Vertex{body.vertices.dart[k]}, seen, [&](Dart d) {
        const std::uint32_t c = body.cell(body.map, d);
        find_nodes(body, c, nodes[c]);
      });
  }

  bool of_springs_ = false;
};

using TetrahedronNodesView = ElementNodesView<TetrahedronNodes>;
using SolidNodesView = ElementNodesView<SolidNodes>;
using TriangleNodesView = ElementNodesView<TriangleNodes>;

}  // namespace dartboard
