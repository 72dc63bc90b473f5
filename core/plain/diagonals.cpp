#include "core/plain/diagonals.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace dartboard {
namespace {

struct Weights {
  double edge, upright_edge, face, volume;  // upright: those between the triangles of a prism, to the tip of a pyramid
};

Weights weights_of(CellKind kind, Diagonals diagonals) {
  switch (kind) {
    case CellKind::quadrilateral: return {.375, .375, .75, 0};
    case CellKind::pyramid: return {.525, .675, .6, 0};
    case CellKind::prism: return {.4, .4 / 3, 1.6 / 3, 0};
    case CellKind::hexahedron:
      if (diagonals == Diagonals::faces) return {.1, .1, .4, 0};
      if (diagonals == Diagonals::volumes) return {.2, .2, 0, .9};
      return {.15, .15, .2, .45};
    case CellKind::triangle:
    case CellKind::tetrahedron: break;
  }
  return {1, 1, 0, 0};
}

bool is_upright(CellKind kind, int a, int b) {
  return (kind == CellKind::prism && b == a + 3) || (kind == CellKind::pyramid && b == 4);
}

struct SpringsOfKind {
  std::vector<CornerSpring> edges, diagonals;
};

SpringsOfKind springs_of(CellKind kind, Diagonals which) {
  std::set<std::pair<int, int>> edges, of_faces;
  for (const std::vector<int>& cycle : faces_of(kind)) {
    const std::size_t n = cycle.size();
    for (std::size_t k = 0; k < n; ++k) edges.insert(std::minmax({cycle[k], cycle[(k + 1) % n]}));
    if (n != 4) continue;
    of_faces.insert(std::minmax({cycle[0], cycle[2]}));
    of_faces.insert(std::minmax({cycle[1], cycle[3]}));
  }
  const Weights weights = weights_of(kind, which);
  SpringsOfKind springs;
  const bool faces = which == Diagonals::faces || which == Diagonals::all;
  const bool volumes = which == Diagonals::volumes || which == Diagonals::all;
  for (int a = 0; a < node_count(kind); ++a)
    for (int b = a + 1; b < node_count(kind); ++b) {
      if (edges.contains({a, b}))
        springs.edges.push_back({a, b, is_upright(kind, a, b) ? weights.upright_edge : weights.edge});
      else if (of_faces.contains({a, b}) && faces)
        springs.diagonals.push_back({a, b, weights.face});
      else if (!of_faces.contains({a, b}) && volumes)
        springs.diagonals.push_back({a, b, weights.volume});
    }
  if (springs.diagonals.empty())
    for (CornerSpring& edge : springs.edges) edge.weight = 1.0;
  return springs;
}

const SpringsOfKind& table(CellKind kind, Diagonals diagonals) {
  static const std::vector<SpringsOfKind> all = [] {
    std::vector<SpringsOfKind> made;
    for (int k = 0; k <= static_cast<int>(CellKind::hexahedron); ++k)
      for (std::size_t which = 0; which < diagonals_names.size(); ++which)
        made.push_back(springs_of(static_cast<CellKind>(k), static_cast<Diagonals>(which)));
    return made;
  }();
  return all[static_cast<std::size_t>(kind) * diagonals_names.size() + static_cast<std::size_t>(diagonals)];
}

}  // namespace

std::span<const CornerSpring> diagonals_of(CellKind kind, Diagonals diagonals) {
  return table(kind, diagonals).diagonals;
}

std::span<const CornerSpring> edges_beside(CellKind kind, Diagonals diagonals) { return table(kind, diagonals).edges; }

}  // namespace dartboard
