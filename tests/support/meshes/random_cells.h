#pragma once
// Meshes whose cells lie scattered.

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// Some cells of a mesh, each taken by a chance of `share`, in a random order: many touch at points and edges alone,
/// and some lie apart. Points of no cell stay.
inline Mesh random_cells_of(const Mesh& mesh, double share, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (static_cast<double>(bits()) < share * 4294967296.0) cells.push_back(c);
  for (std::size_t k = cells.size(); k > 1; --k) std::swap(cells[k - 1], cells[bits() % k]);
  Mesh some;
  some.points = mesh.points;
  for (const std::size_t c : cells) some.add_cell(mesh.kinds[c], mesh.cell(c));
  return some;
}

}  // namespace dartboard
