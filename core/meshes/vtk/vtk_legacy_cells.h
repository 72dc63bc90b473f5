#pragma once
// A list of cells in a legacy VTK file: CELLS of a grid, or POLYGONS and the like.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/meshes/bytes/file_numbers.h"

namespace dartboard {

/// The points of each cell, whose types are given by another list or by the name of this one.
struct VtkLegacyCells {
  std::vector<std::int64_t> start{0}, all_points;
  std::vector<std::uint32_t> lines;  // of each cell
  bool found = false;

  std::size_t count() const { return start.size() - 1; }
  std::span<const std::int64_t> points(std::size_t c) const {
    return std::span(all_points)
        .subspan(static_cast<std::size_t>(start[c]), static_cast<std::size_t>(start[c + 1] - start[c]));
  }

  /// Read what follows a keyword: two numbers, and a list as in versions 2 to 4, or offsets and points.
  ///
  /// throws  IoError for a list that is not as long as announced, and for a second list
  void read(TextScanner& scan, FileNumbers& numbers, std::string_view keyword, bool has_offsets);
};

}  // namespace dartboard
