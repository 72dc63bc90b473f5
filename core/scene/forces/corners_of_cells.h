#pragma once
// The corners of some cells of the mesh, as they are in a body without a map.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/scene/forces/body_force.h"
#include "core/views/followed_cells.h"

namespace dartboard {

class CornersOfCells {
 public:
  /// `cells` are numbers in the mesh in any order, each any number of times.
  CornersOfCells(const BodyWithoutMap& body, std::vector<std::uint32_t> cells) : cells_(std::move(cells)) {
    std::ranges::sort(cells_);
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    corners_ = body.corners_of(cells_);
  }

  /// pre  one of the cells
  bool is_there(std::uint32_t cell) const { return !of(cell).empty(); }
  /// The vertex at a point of the mesh.
  /// pre  the cell is there, and the point is one of its corners
  std::uint32_t vertex_at(std::uint32_t cell, std::uint32_t point) const {
    return FollowedCells::vertex_at(of(cell), point);
  }

 private:
  const std::vector<CellCorner>& of(std::uint32_t cell) const {
    return corners_[static_cast<std::size_t>(std::ranges::lower_bound(cells_, cell) - cells_.begin())];
  }

  std::vector<std::uint32_t> cells_;  // ascending
  std::vector<std::vector<CellCorner>> corners_;
};

}  // namespace dartboard
