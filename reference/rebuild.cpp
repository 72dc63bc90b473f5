#include "reference/rebuild.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/error.h"
#include "reference/cell_shape.h"
#include "reference/exact_measure.h"

namespace dartboard::reference {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// The edges of one cell, each once.
void edges_of_cell(const Mesh& mesh, std::size_t c, std::vector<Pair>& edges) {
  const auto cell = mesh.cell(c);
  edges.clear();
  for (const auto& [a, b] : own_edges(mesh.kinds[c]))
    edges.push_back(std::minmax({cell[static_cast<std::size_t>(a)], cell[static_cast<std::size_t>(b)]}));
}

void check_cell(const Mesh& mesh, std::size_t c) {
  const auto cell = mesh.cell(c);
  for (std::size_t k = 0; k < cell.size(); ++k) {
    if (cell[k] >= mesh.points.size())
      throw InputError(fmt::format("cell {} names point {}, and there are {}", c, cell[k], mesh.points.size()));
    if (std::find(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(k), cell[k]) !=
        cell.begin() + static_cast<std::ptrdiff_t>(k))
      throw InputError(fmt::format("cell {} names point {} twice", c, cell[k]));
  }
}

}  // namespace

Rebuilt rebuild(const Mesh& mesh, const Material& material) {
  Rebuilt out;
  out.mass.assign(mesh.points.size(), 0.0);

  std::vector<Pair> edges;
  std::vector<std::pair<Pair, double>> soup;  // with the volume (area) of the cell
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    check_cell(mesh, c);
    const auto cell = mesh.cell(c);

    // eq. (1): an equal share of the mass of the cell to each of its points; handedness does not affect mass
    const double measure = exact_measure(mesh, c);
    const double share = material.density * measure / static_cast<double>(cell.size());
    for (std::uint32_t p : cell) out.mass[p] += share;

    edges_of_cell(mesh, c, edges);
    for (const Pair& edge : edges) soup.emplace_back(edge, measure);
  }

  // a run of equal pairs is one edge; its length is the number of cells around it
  std::sort(soup.begin(), soup.end());
  for (std::size_t first = 0, last = 0; first < soup.size(); first = last) {
    double volume = 0.0;
    for (; last < soup.size() && soup[last].first == soup[first].first; ++last) volume += soup[last].second;
    const auto around = static_cast<std::uint32_t>(last - first);
    const auto [a, b] = soup[first].first;
    const double length = (mesh.points[b] - mesh.points[a]).norm();
    if (material.young == 0.0) {
      out.springs.push_back({a, b, material.stiffness * around, material.damping * around, length});
    } else {
      const double stiffness = material.young * volume / (length * length);
      out.springs.push_back({a, b, stiffness, material.damping * stiffness / material.stiffness, length});
    }
    out.cells.push_back(around);
  }
  return out;
}

}  // namespace dartboard::reference
