#include "core/scene/file/springs_beside_edges.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/scene/file/load_mesh.h"

namespace dartboard {
namespace {

// Triangles with a larger angle at rest are not meant to be flat; rounding to the digits of a file tilts them by less.
constexpr double largest_tilt = 1e-6;

void require_diagonals(const SceneFile& scene, const Problem& problem) {
  const CellMaterials materials = problem.cell_materials();
  bool springs = false;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    if (materials[c].model != Model::springs) continue;
    springs = true;
    if (!diagonals_of(problem.mesh.kinds[c], scene.diagonals).empty()) return;
  }
  const std::string found = fmt::format("is \"{}\"", name(scene.diagonals));
  if (!springs)
    scene.fail("/diagonals", found + ", and all cells are made of elements", "cells of springs, or no such key");
  scene.fail("/diagonals", found + ", and no cell has such diagonals",
             scene.diagonals == Diagonals::volumes ? "hexahedra, or no such key"
                                                   : "hexahedra, prisms, pyramids or quadrilaterals, or no such key");
}

void require_flat_triangles(const SceneFile& scene, const Mesh& mesh) {
  const std::string found = fmt::format("is {} N m", scene.bending.rigidity);
  // by edge: the direction away from it in the first face met
  std::map<std::pair<std::uint32_t, std::uint32_t>, Eigen::Vector3d> away_from;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (dimension(mesh.kinds[c]) == 3) continue;
    if (mesh.kinds[c] != CellKind::triangle)
      scene.fail("/bending/rigidity", fmt::format("{}, and cell {} is a {}", found, c, name(mesh.kinds[c])),
                 "triangles, or 'second_neighbours' in its place");
    const auto nodes = mesh.cell(c);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = nodes[k], b = nodes[(k + 1) % 3], corner = nodes[(k + 2) % 3];
      const Eigen::Vector3d along = (mesh.points[b] - mesh.points[a]).normalized();
      const Eigen::Vector3d side = mesh.points[corner] - mesh.points[a];
      const Eigen::Vector3d away = (side - along.dot(side) * along).normalized();
      const auto [at, is_first] = away_from.try_emplace(std::minmax(a, b), away);
      const double tilt = (at->second + away).norm();
      if (!is_first && !(tilt <= largest_tilt))
        scene.fail("/bending/rigidity",
                   fmt::format("{}, and the surface is bent by {:.3g} at the edge of points {} and {} at rest", found,
                               tilt, number_in_file(scene, at->first.first), number_in_file(scene, at->first.second)),
                   "a flat sheet");
    }
  }
}

}  // namespace

void require_springs_beside_edges(const SceneFile& scene, const Problem& problem) {
  if (scene.diagonals != Diagonals::none) require_diagonals(scene, problem);
  if (!scene.bending.any()) return;
  const auto is_polygon = [](CellKind kind) { return dimension(kind) == 2; };
  if (std::ranges::none_of(problem.mesh.kinds, is_polygon))
    scene.fail("/bending", "cannot be combined with a solid, whose cells do not bend at edges", "a surface");
  if (scene.bending.rigidity > 0.0) require_flat_triangles(scene, problem.mesh);
}

double mean_stiffness_beside(const Mesh& mesh, double young, std::span<const std::uint32_t> cells,
                             Diagonals diagonals) {
  double sum = 0.0, edges = 0.0;
  for (const std::uint32_t c : cells) {
    if (c >= mesh.cell_count()) continue;  // links have no diagonals
    const auto nodes = mesh.cell(c);
    const double measure = std::abs(signed_measure(mesh, c));
    for (const CornerSpring& edge : edges_beside(mesh.kinds[c], diagonals)) {
      const Eigen::Vector3d line =
          mesh.points[nodes[static_cast<std::size_t>(edge.b)]] - mesh.points[nodes[static_cast<std::size_t>(edge.a)]];
      sum += edge.weight * young * measure / line.squaredNorm();
      edges += 1.0;
    }
  }
  return edges == 0.0 ? 0.0 : sum / edges;
}

}  // namespace dartboard
