#include "reference/cell_shape.h"

#include <algorithm>
#include <cstddef>

namespace dartboard::reference {
namespace {

struct Shape {
  std::vector<std::vector<int>> faces;
  std::vector<std::pair<int, int>> edges;
};

// A cycle of corners, without those that coincide with the one before.
std::vector<int> distinct(const std::vector<int>& cycle) {
  std::vector<int> nodes;
  for (const int k : cycle)
    if (nodes.empty() || nodes.back() != k) nodes.push_back(k);
  while (nodes.size() > 1 && nodes.back() == nodes.front()) nodes.pop_back();
  return nodes;
}

Shape shape_of(CellKind kind) {
  Shape shape;
  if (dimension(kind) == 2) {
    shape.faces.push_back(kind == CellKind::triangle ? std::vector{0, 1, 2} : std::vector{0, 1, 2, 3});
  } else {
    const auto corner = corners_of(kind);
    for (const std::size_t axis : {1u, 2u, 4u})
      for (const std::size_t side : {std::size_t{0}, axis}) {
        const std::size_t a = axis == 1 ? 2 : 1, b = axis == 4 ? 2 : 4;  // around the side
        const auto cycle = distinct({corner[side], corner[side + a], corner[side + a + b], corner[side + b]});
        if (cycle.size() > 2) shape.faces.push_back(cycle);
      }
  }
  for (const auto& face : shape.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int p = face[k], q = face[(k + 1) % face.size()];
      shape.edges.emplace_back(std::min(p, q), std::max(p, q));
    }
  std::sort(shape.edges.begin(), shape.edges.end());
  shape.edges.erase(std::unique(shape.edges.begin(), shape.edges.end()), shape.edges.end());
  return shape;
}

const Shape& shape(CellKind kind) {
  static const std::array<Shape, 6> all{shape_of(CellKind::triangle),    shape_of(CellKind::quadrilateral),
                                        shape_of(CellKind::tetrahedron), shape_of(CellKind::pyramid),
                                        shape_of(CellKind::prism),       shape_of(CellKind::hexahedron)};
  return all[static_cast<std::size_t>(kind)];
}

}  // namespace

std::array<int, 8> corners_of(CellKind kind) {
  switch (kind) {
    case CellKind::hexahedron: return {0, 1, 3, 2, 4, 5, 7, 6};
    case CellKind::prism: return {0, 1, 2, 2, 3, 4, 5, 5};    // an edge of either triangle has no length
    case CellKind::pyramid: return {0, 1, 3, 2, 4, 4, 4, 4};  // the top is a point
    default: return {0, 1, 2, 2, 3, 3, 3, 3};
  }
}

std::span<const std::vector<int>> own_faces(CellKind kind) { return shape(kind).faces; }
std::span<const std::pair<int, int>> own_edges(CellKind kind) { return shape(kind).edges; }

}  // namespace dartboard::reference
