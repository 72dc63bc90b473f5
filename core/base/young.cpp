#include "core/base/young.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {

namespace {

std::vector<std::uint32_t> all_cells(const Mesh& mesh) {
  std::vector<std::uint32_t> cells(mesh.cell_count() + mesh.links.size());
  std::iota(cells.begin(), cells.end(), 0u);
  return cells;
}

}  // namespace

std::optional<std::size_t> first_loose_cell(const Mesh& mesh) { return first_loose_cell(mesh, all_cells(mesh)); }

std::optional<std::size_t> first_loose_cell(const Mesh& mesh, std::span<const std::uint32_t> cells) {
  for (const std::uint32_t c : cells)
    if (c < mesh.cell_count() && mesh.kinds[c] != CellKind::tetrahedron && mesh.kinds[c] != CellKind::triangle)
      return c;
  return {};
}

double mean_stiffness(const Mesh& mesh, double young) { return mean_stiffness(mesh, young, all_cells(mesh)); }

double mean_stiffness(const Mesh& mesh, double young, std::span<const std::uint32_t> cells) {
  if (const auto c = first_loose_cell(mesh, cells))
    throw InputError(
        fmt::format("cell {} is a {}, whose edges alone do not hold its shape; expected tetrahedra or triangles", *c,
                    name(mesh.kinds[*c])));
  double sum = 0.0, edges = 0.0;
  const auto add = [&](std::uint32_t a, std::uint32_t b, double measure) {
    sum += young * measure / (mesh.points[b] - mesh.points[a]).squaredNorm();
    edges += 1.0;
  };
  for (const std::uint32_t c : cells) {
    if (c >= mesh.cell_count()) {
      const auto [a, b] = mesh.links[c - mesh.cell_count()];
      add(a, b, (mesh.points[b] - mesh.points[a]).norm());
      continue;
    }
    const auto nodes = mesh.cell(c);
    const double measure = std::abs(signed_measure(mesh, c));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) add(nodes[j], nodes[i], measure);
  }
  return edges == 0.0 ? 0.0 : sum / edges;
}

}  // namespace dartboard
