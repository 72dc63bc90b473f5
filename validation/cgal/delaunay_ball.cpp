#include "validation/cgal/delaunay_ball.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Storage = CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Storage>;

/// The tetrahedra, each right-handed by exact arithmetic. Random points are in general position, so that they are
/// unique and CGAL's order of insertion does not matter.
Mesh tetrahedralise(std::vector<Eigen::Vector3d> points) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
  for (const auto& p : points)
    numbered.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), static_cast<std::uint32_t>(numbered.size()));
  const Delaunay delaunay(numbered.begin(), numbered.end());

  std::vector<std::array<std::uint32_t, 4>> cells;
  for (const auto cell : delaunay.finite_cell_handles()) {
    std::array<std::uint32_t, 4> nodes{};
    for (int k = 0; k < 4; ++k) nodes[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
    std::sort(nodes.begin(), nodes.end());
    cells.push_back(nodes);
  }
  std::sort(cells.begin(), cells.end());

  Mesh mesh;
  mesh.points = std::move(points);
  for (auto& nodes : cells) {
    const auto at = [&](std::size_t k) -> const Kernel::Point_3& { return numbered[nodes[k]].first; };
    if (CGAL::orientation(at(0), at(1), at(2), at(3)) == CGAL::NEGATIVE) std::swap(nodes[2], nodes[3]);
    mesh.add_cell(CellKind::tetrahedron, nodes);
  }
  return mesh;
}

/// Every point is used, and every volume is positive as a double too.
bool is_sound(const Mesh& mesh) {
  std::vector<bool> used(mesh.points.size());
  for (const std::uint32_t node : mesh.nodes) used[node] = true;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (!(signed_measure(mesh, c) > 0.0)) return false;
  return std::find(used.begin(), used.end(), false) == used.end();
}

}  // namespace

Mesh delaunay_ball(int points, std::uint64_t seed) {
  if (points < 4) throw InputError(fmt::format("delaunay_ball: points = {}, expected at least 4", points));
  SplitMix64 random(seed);
  for (;;) {
    std::vector<Eigen::Vector3d> drawn;
    for (int k = 0; k < points; ++k) drawn.push_back(random.next_in_ball());
    std::sort(drawn.begin(), drawn.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
    });
    Mesh mesh = tetrahedralise(std::move(drawn));
    if (is_sound(mesh)) return mesh;
  }
}

std::span<const NamedMesh> delaunay_meshes() {
  static const std::vector<NamedMesh> all{
      {"delaunay_ball_40", "Delaunay tetrahedra of 40 random points in a ball", [] { return delaunay_ball(40, 1); }},
      {"delaunay_ball_250", "Delaunay tetrahedra of 250 random points in a ball", [] { return delaunay_ball(250, 2); }},
  };
  return all;
}

}  // namespace dartboard
