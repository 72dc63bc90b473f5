#include "validation/paper/pinched_vertex.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "validation/conservation/conservation.h"
#include "validation/paper/moves_as_reference.h"

namespace dartboard {
namespace {

struct LinksOfBody {
  bool valid = false, agree = true;
  std::set<long> euler;
};

LinksOfBody links_of(const Mesh& mesh) {
  Problem problem;
  problem.mesh = mesh;
  const auto body = build_body<Map3, Held::by_every_dart>(problem);
  LinksOfBody links;
  links.valid = check(body.map).empty() && body.vertices.size() == mesh.points.size();
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    const Vertex v{body.vertices.dart[k]};
    const long by_map = static_cast<long>(incident_cells<1>(body.map, v).size()) -
                        static_cast<long>(incident_cells<2>(body.map, v).size()) +
                        static_cast<long>(incident_cells<3>(body.map, v).size());
    // an edge at the vertex is a corner of its link, a face a side, a cell a triangle
    std::set<std::uint32_t> corners;
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    long triangles = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto nodes = mesh.cell(c);
      if (std::ranges::find(nodes, body.vertices.point[k]) == nodes.end()) continue;
      ++triangles;
      for (const std::uint32_t p : nodes)
        for (const std::uint32_t q : nodes) {
          if (p == body.vertices.point[k] || q == body.vertices.point[k]) continue;
          corners.insert(p);
          if (p < q) sides.insert({p, q});
        }
    }
    const long by_mesh = static_cast<long>(corners.size()) - static_cast<long>(sides.size()) + triangles;
    links.agree = links.agree && by_map == by_mesh;
    links.euler.insert(by_mesh);
  }
  return links;
}

bool are_balls(const std::set<long>& euler) {
  return std::ranges::all_of(euler, [](long e) { return e == 1 || e == 2; });
}

}  // namespace

ClaimAnswer try_pinched_vertex(const Mesh& manifold, const Mesh& pinched) {
  const LinksOfBody a = links_of(manifold), b = links_of(pinched);
  const double a_off = motion_beside_reference(manifold), b_off = motion_beside_reference(pinched);
  const bool maps = a.valid && b.valid && a.agree && b.agree;
  const bool move = a_off <= 1.0 && b_off <= 1.0;
  return {maps && move && are_balls(a.euler) && !are_balls(b.euler),
          fmt::format("links of Euler characteristic {} to {}, and {} to {}; maps {}; motion {:.2g} and "
                      "{:.2g} of the bound from the reference's",
                      *a.euler.begin(), *a.euler.rbegin(), *b.euler.begin(), *b.euler.rbegin(),
                      maps ? "valid" : "NOT valid", a_off, b_off)};
}

}  // namespace dartboard
