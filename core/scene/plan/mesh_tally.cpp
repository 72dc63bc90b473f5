#include "core/scene/plan/mesh_tally.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "core/base/disjoint_sets.h"
#include "core/mechanics/problem_parts.h"

namespace dartboard {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Numbers tuples of points in the order in which they are met first: a chain for each smallest point.
template <std::size_t n>
class FirstMet {
 public:
  using Key = std::array<std::uint32_t, n>;
  explicit FirstMet(std::size_t points) : head_(points, none) {}

  /// The number of the tuple, and whether it is new.
  std::pair<std::uint32_t, bool> number(Key key) {
    std::sort(key.begin(), key.end());
    for (std::uint32_t k = head_[key[0]]; k != none; k = met_[k].next)
      if (met_[k].key == key) return {k, false};
    met_.push_back({key, head_[key[0]]});
    head_[key[0]] = static_cast<std::uint32_t>(met_.size() - 1);
    return {head_[key[0]], true};
  }

 private:
  struct Met {
    Key key;
    std::uint32_t next;
  };
  std::vector<std::uint32_t> head_;
  std::vector<Met> met_;
};

MeshTally tally_of_chains(const Mesh& mesh) {
  MeshTally t;
  t.vertices = mesh.points.size();
  t.edges = mesh.links.size();
  DisjointSets together(t.vertices);
  t.point.resize(t.vertices);
  std::iota(t.point.begin(), t.point.end(), 0u);
  for (const auto& [a, b] : mesh.links) {
    t.ends.push_back({a, b});
    together.join(a, b);
  }
  t.components = together.count();
  t.cells_of_edge.assign(t.edges, 1);  // a link is a cell of its own
  t.edge_on_boundary.assign(t.edges, 0);
  return t;
}

/// Add the counts of another part of a mesh, whose points and cells have these numbers in it.
void append(MeshTally& t, const MeshTally& part, std::span<const std::uint32_t> point,
            std::span<const std::uint32_t> cell) {
  const auto first = static_cast<std::uint32_t>(t.vertices);
  for (const std::uint32_t p : part.point) t.point.push_back(point[p]);
  for (const auto& [a, b] : part.ends) t.ends.push_back({first + a, first + b});
  for (const auto& [a, b] : part.cells_of_facet) t.cells_of_facet.push_back({cell[a], cell[b]});
  const auto add_column = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add_column(t.cells_of_edge, part.cells_of_edge);
  add_column(t.edge_on_boundary, part.edge_on_boundary);
  for (const auto count :
       {&MeshTally::vertices, &MeshTally::edges, &MeshTally::faces, &MeshTally::cells, &MeshTally::darts,
        &MeshTally::components, &MeshTally::boundary_facets, &MeshTally::boundary_corners})
    t.*count += part.*count;
}

}  // namespace

MeshTally tally_of(const Mesh& mesh) {
  MeshTally t;
  if (is_mixed(mesh)) {
    Problem problem;
    problem.mesh = mesh;
    for (const ProblemPart& part : parts_of(problem)) append(t, tally_of(part.problem.mesh), part.point, part.cell);
    return t;
  }
  if (!mesh.links.empty()) return tally_of_chains(mesh);
  t.cells = mesh.cell_count();
  std::vector<std::uint32_t> vertex_of(mesh.points.size(), none), last_cell;  // last_cell: by edge
  FirstMet<2> edges(mesh.points.size());
  FirstMet<4> faces(mesh.points.size());
  DisjointSets together(t.cells);  // by facets
  const bool solid = t.cells > 0 && dimension(mesh.kinds[0]) == 3;

  struct Facet {
    std::uint32_t cell, cells, corners;
  };
  std::vector<Facet> facets;               // by face of a solid, edge of a surface
  std::vector<std::uint32_t> facet_edges;  // by face of a solid: its edges, 4 places each
  const auto meet_facet = [&t, &facets, &together](std::uint32_t number, std::uint32_t cell, std::size_t corners) {
    if (number == facets.size()) {
      facets.push_back({cell, 1, static_cast<std::uint32_t>(corners)});
    } else {
      ++facets[number].cells;
      together.join(facets[number].cell, cell);
      t.cells_of_facet.push_back({facets[number].cell, cell});
    }
  };

  for (std::uint32_t c = 0; c < t.cells; ++c) {
    const auto node = mesh.cell(c);
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      const std::size_t corners = cycle.size();
      std::array<std::uint32_t, 4> face{none, none, none, none}, around{none, none, none, none};
      for (std::size_t k = 0; k < corners; ++k) {
        const std::uint32_t a = node[static_cast<std::size_t>(cycle[k])],
                            b = node[static_cast<std::size_t>(cycle[(k + 1) % corners])];
        face[k] = a;
        for (const std::uint32_t p : {a, b})
          if (vertex_of[p] == none) {
            vertex_of[p] = static_cast<std::uint32_t>(t.point.size());
            t.point.push_back(p);
          }
        const auto [edge, is_new] = edges.number({a, b});
        if (is_new) {
          t.ends.push_back({vertex_of[a], vertex_of[b]});
          t.cells_of_edge.push_back(0);
          last_cell.push_back(none);
        }
        if (last_cell[edge] != c) ++t.cells_of_edge[edge];
        last_cell[edge] = c;
        around[k] = edge;
        if (!solid) meet_facet(edge, c, 2);
      }
      t.darts += 2 * corners;
      if (!solid) continue;
      const auto [number, is_new] = faces.number(face);
      meet_facet(number, c, corners);
      if (is_new) facet_edges.insert(facet_edges.end(), around.begin(), around.end());
    }
  }
  t.vertices = t.point.size();
  t.edges = t.ends.size();
  t.faces = solid ? facets.size() : t.cells;
  t.components = together.count();
  t.edge_on_boundary.assign(t.edges, 0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].cells != 1) continue;
    ++t.boundary_facets;
    t.boundary_corners += facets[f].corners;
    const std::span<const std::uint32_t> around =
        solid ? std::span(facet_edges).subspan(4 * f, facets[f].corners) : std::span<const std::uint32_t>();
    for (const std::uint32_t edge : around) t.edge_on_boundary[edge] = 1;
    if (!solid) t.edge_on_boundary[f] = 1;
  }
  return t;
}

}  // namespace dartboard
