#pragma once
// Crossed cells: their corners are listed in an order that does not go round their faces.

#include <cstdint>
#include <string>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

struct CrossedCells {
  std::vector<std::uint32_t> cells;  // ascending
  std::size_t voxel_order = 0;       // how many become valid by swapping corners as in voxels and pixels
  std::string swap = {};             // what makes the first of them valid: "swap the third and fourth points of ..."

  bool any() const { return !cells.empty(); }
  /// "3 cells are crossed, with corners that do not go round their faces: cells 0, 4, 7; they look like voxel order".
  std::string found() const;
  /// The remedy for them.
  std::string remedy() const;
};

/// A volume crosses itself if it is right-handed at some of its Gauss points, those that elements integrate at, and
/// left-handed at others, a prism also if one of its corners is swapped with one of its other end; a quadrilateral if
/// two of its corners turn against the other two, seen along its normal. A quadrilateral with one corner that turns
/// back has the shape of an arrow, and does not cross itself.
///
/// pre  nodes are points of the mesh
CrossedCells find_crossed_cells(const Mesh& mesh);

}  // namespace dartboard
