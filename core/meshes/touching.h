#pragma once
// Cells that touch in a point or an edge without a face between them: one point of the mesh, several vertices of the
// map.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// The points and edges around which cells are not all joined by faces (in a surface, by edges). A quasi-manifold has a
/// vertex, or an edge, for each group of joined cells (section 2.1, Fig. 3).
struct TouchingCells {
  std::vector<std::uint32_t> points;                // ascending; those of several vertices
  std::vector<std::array<std::uint32_t, 2>> edges;  // ascending pairs of points; those of several edges
  std::vector<std::uint32_t> copied;                // by added point: the point that it is a copy of

  bool any() const { return !points.empty() || !edges.empty(); }
};

/// Give each vertex that the map of a mesh will have a point of its own.
///
/// The cell of the lowest number keeps the point, cells not joined to it get the next numbers, at the same place.
/// An edge whose ends are one vertex each stays two edges between the same vertices.
/// returns  the touching cells, by the old numbers
/// cost     O(n log n) in the cells
TouchingCells split_touching_points(Mesh& mesh);

/// "cells touch at 3 points and 1 edge without sharing a face (points 4, 7, 9; edge 4-7); ...", by the numbers of the
/// file, whose points are at `place_of_point`, or at their own numbers when it is empty (LoadedMesh); empty if no cells
/// touch.
std::string to_string(const TouchingCells& touching, std::span<const std::uint32_t> place_of_point);

}  // namespace dartboard
