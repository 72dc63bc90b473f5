#include "core/operations/subdivide.h"

#include <algorithm>
#include <utility>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/sew.h"

namespace dartboard {
namespace {

using Darts = Subdivision::Darts;

/// The darts of the tetrahedron of d, which becomes the first: the constant table laid over the map.
template <class Map>
Darts tetrahedron(const Map& map, Dart d) {
  Darts darts;
  darts.fill(no_dart);
  if constexpr (Map::tetrahedral) d.index -= d.index % 24;
  darts[0] = d;
  std::array<std::uint8_t, 24> queue{};
  std::size_t size = 1;
  for (std::size_t k = 0; k < size; ++k)
    for (int i = 0; i < 3; ++i) {
      const std::size_t p = queue[k], q = tet_darts.alpha[static_cast<std::size_t>(i)][p];
      const Dart next = map.alpha(i, darts[p]);
      if (darts[q] == no_dart) {
        if (std::find(darts.begin(), darts.end(), next) != darts.end())
          throw TopologyError("the volume of " + to_string(d) + " is no tetrahedron: it cannot be subdivided");
        darts[q] = next;
        queue[size++] = static_cast<std::uint8_t>(q);
      } else if (darts[q] != next) {
        throw TopologyError("the volume of " + to_string(d) + " is no tetrahedron: it cannot be subdivided");
      }
    }
  return darts;
}

constexpr std::size_t other_end(std::size_t p) { return tet_darts.node[tet_darts.alpha[0][p]]; }

/// The dart of `face` at `node` on the edge towards `other`.
std::size_t local_dart(std::size_t face, std::size_t node, std::size_t other) {
  std::size_t p = 6 * face;
  while (tet_darts.node[p] != node || other_end(p) != other) ++p;
  return p;
}

template <int i>
std::uint8_t nodes_of_cell(std::size_t p) {
  if constexpr (i == 1) return static_cast<std::uint8_t>(1u << tet_darts.node[p] | 1u << other_end(p));
  if constexpr (i == 2) return static_cast<std::uint8_t>(15u & ~(1u << (p / 6)));
  return 15;
}

/// A face of a child and the face that it is to be sewn to.
struct Seam {
  Dart a, b;
};

/// The children, and the seams between them and to the outside, while the parents are still in place.
template <class Map>
class Plan {
 public:
  explicit Plan(Subdivision& subdivision) : s_(subdivision) {}

  void add_children(Map& map) {
    for (std::uint32_t k = 0; k < s_.parents.size(); ++k)
      for (std::uint8_t n = 0; n < 4; ++n)
        if (s_.parents[k].of_cell >> n & 1u)
          s_.children.push_back({k, n, tetrahedron(map, add_cell(map, CellKind::tetrahedron))});
  }

  std::vector<Seam> seams(const Map& map) const {
    std::vector<Seam> seams;
    for (const auto& child : s_.children) {
      const auto& parent = s_.parents[child.parent];
      const std::size_t n = child.replaced;
      for (std::size_t m = 0; m < 4; ++m) {
        if (m == n) {  // the parent's face opposite n is this child's
          const Dart outside = map.template alpha<3>(parent.darts[6 * n]);
          if (outside != parent.darts[6 * n]) seams.push_back({child.darts[6 * n], in_child(outside, true)});
        } else if (parent.of_cell >> m & 1u) {  // between two children: the edge of the other two nodes is on both
          if (m < n) continue;
          std::size_t j = 0;
          while (j == n || j == m) ++j;
          const std::size_t l = 6 - n - m - j;
          seams.push_back({child.darts[local_dart(m, j, l)], child_of(child.parent, m).darts[local_dart(n, j, l)]});
        } else {  // a part of a face around the cell: its darts at the new vertex correspond across it
          std::size_t p = 6 * m;
          while (tet_darts.node[p] != n) ++p;
          const Dart across = map.template alpha<3>(parent.darts[p]);
          if (across != parent.darts[p]) seams.push_back({child.darts[p], in_child(across, false)});
        }
      }
    }
    return seams;
  }

 private:
  const Subdivision::Child& child_of(std::uint32_t parent, std::size_t n) const {
    return *std::find_if(s_.children.begin(), s_.children.end(),
                         [=](const auto& c) { return c.parent == parent && c.replaced == n; });
  }

  /// The dart of a child that corresponds to a dart of its parent: on the side opposite the replaced node, or at the
  /// new vertex. Darts of other tetrahedra are returned unchanged.
  Dart in_child(Dart d, bool opposite) const {
    for (std::uint32_t k = 0; k < s_.parents.size(); ++k) {
      const auto& darts = s_.parents[k].darts;
      const auto p = static_cast<std::size_t>(std::find(darts.begin(), darts.end(), d) - darts.begin());
      if (p < 24) return child_of(k, opposite ? p / 6 : tet_darts.node[p]).darts[p];
    }
    return d;
  }

  Subdivision& s_;
};

}  // namespace

Dart Subdivision::vertex() const {
  const Child& child = children.front();
  std::size_t p = 0;
  while (tet_darts.node[p] != child.replaced) ++p;
  return child.darts[p];
}

template <int i, class Map>
Subdivision subdivide(Map& map, Cell<i> cell) {
  map.require_live(cell.dart);
  Subdivision subdivision;
  subdivision.cell_vertices = i + 1;
  std::vector<Dart> meeting{cell.dart};
  if constexpr (i < 3) {
    meeting.clear();
    for (const Volume v : incident_cells<3>(map, cell)) meeting.push_back(v.dart);
    std::size_t darts = 0;
    for_each_dart_of(map, cell, [&darts](Dart) { ++darts; });
    if (darts != meeting.size() * (i == 1 ? 4 : 6))
      throw TopologyError("a tetrahedron meets the cell of " + to_string(cell.dart) + " more than once");
  }
  for (const Dart d : meeting) {
    Subdivision::Parent parent{tetrahedron(map, d), 0};
    const auto p = std::find(parent.darts.begin(), parent.darts.end(), d) - parent.darts.begin();
    parent.of_cell = nodes_of_cell<i>(static_cast<std::size_t>(p));
    subdivision.parents.push_back(parent);
  }

  Plan<Map> plan(subdivision);
  plan.add_children(map);
  const std::vector<Seam> seams = plan.seams(map);
  for (const auto& parent : subdivision.parents)
    for (std::size_t face = 0; face < 4; ++face) unsew<3>(map, parent.darts[6 * face]);
  for (const Seam& seam : seams)
    if (map.template is_free<3>(seam.a)) sew<3>(map, seam.a, seam.b);  // each seam between children is found twice
  for (const auto& parent : subdivision.parents) remove_cell(map, parent.darts[0]);
  return subdivision;
}

DARTBOARD_SUBDIVIDE(, Map3)
DARTBOARD_SUBDIVIDE(, TetMap)

}  // namespace dartboard
