#pragma once
// Masses and springs from an unordered list of cells, with which an incremental body must agree after any change.

#include <cstdint>
#include <vector>

#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard::reference {

/// One edge of the mesh, as the spring it carries; `a` < `b` are point numbers.
struct Spring {
  std::uint32_t a, b;
  double stiffness;    // N/m
  double damping;      // N s/m
  double rest_length;  // m
};

/// The mechanics of a body at rest in a mesh.
struct Rebuilt {
  std::vector<double> mass;          // kg, per point of the mesh; zero for a point of no cell
  std::vector<Spring> springs;       // ascending in (a, b)
  std::vector<std::uint32_t> cells;  // how many cells meet at the edge of springs[e]
};

/// The mechanics of a body by eq. (1) and the rule of parallel springs, from its points and cells alone.
///
/// Volumes and areas are exact and rounded once. Edges are found by sorting the point pairs of the cells' edges; no
/// other topology is used, so points and edges that only touch count as one.
///
/// throws  InputError if a cell names a point that does not exist, or one point twice
/// cost    O(C log C) for C cells
Rebuilt rebuild(const Mesh& mesh, const Material& material);

}  // namespace dartboard::reference
