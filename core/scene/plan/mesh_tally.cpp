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

  std::uint32_t number(Key key) {
    std::sort(key.begin(), key.end());
    for (std::uint32_t k = head_[key[0]]; k != none; k = met_[k].next)
      if (met_[k].key == key) return k;
    met_.push_back({key, head_[key[0]]});
    return head_[key[0]] = static_cast<std::uint32_t>(met_.size() - 1);
  }
  std::size_t count() const { return met_.size(); }

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
  for (const auto& [a, b] : mesh.links) together.join(a, b);
  t.components = together.count();
  return t;
}

/// Add the counts of another part of a mesh, whose points and cells have these numbers in it.
void append(MeshTally& t, const MeshTally& part, std::span<const std::uint32_t> point,
            std::span<const std::uint32_t> cell) {
  for (const std::uint32_t p : part.point) t.point.push_back(point[p]);
  for (const auto& [a, b] : part.cells_of_facet) t.cells_of_facet.push_back({cell[a], cell[b]});
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
  std::vector<bool> has_point(mesh.points.size(), false);
  FirstMet<2> edges(mesh.points.size());
  FirstMet<4> faces(mesh.points.size());
  DisjointSets together(t.cells);  // by facets
  const bool solid = t.cells > 0 && dimension(mesh.kinds[0]) == 3;

  struct Facet {
    std::uint32_t cell, cells, corners;
  };
  std::vector<Facet> facets;  // by face of a solid, edge of a surface
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
      std::array<std::uint32_t, 4> face{none, none, none, none};
      for (std::size_t k = 0; k < corners; ++k) {
        const std::uint32_t a = node[static_cast<std::size_t>(cycle[k])],
                            b = node[static_cast<std::size_t>(cycle[(k + 1) % corners])];
        face[k] = a;
        for (const std::uint32_t p : {a, b}) {
          if (!has_point[p]) t.point.push_back(p);
          has_point[p] = true;
        }
        const std::uint32_t edge = edges.number({a, b});
        if (!solid) meet_facet(edge, c, 2);
      }
      t.darts += 2 * corners;
      if (solid) meet_facet(faces.number(face), c, corners);
    }
  }
  t.vertices = t.point.size();
  t.edges = edges.count();
  t.faces = solid ? facets.size() : t.cells;
  t.components = together.count();
  for (const Facet& facet : facets) {
    if (facet.cells != 1) continue;
    ++t.boundary_facets;
    t.boundary_corners += facet.corners;
  }
  return t;
}

}  // namespace dartboard
