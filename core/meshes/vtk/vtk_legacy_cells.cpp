#include "core/meshes/vtk/vtk_legacy_cells.h"

#include <fmt/format.h>

#include "core/meshes/vtk/vtk_legacy_types.h"

namespace dartboard {
namespace {

/// Versions 2 to 4: each cell after the number of its points; `size` numbers altogether.
void read_lists(FileNumbers& numbers, std::uint64_t count, std::uint64_t size, VtkLegacyCells& cells) {
  numbers.begin();
  cells.all_points.reserve(numbers.plausible(size, 4, 2));
  std::uint64_t used = 0;
  for (std::uint64_t c = 0; c < count; ++c) {
    const std::int64_t nodes = numbers.integer(Scalar::int32, {"the number of points of cell", c});
    cells.lines.push_back(static_cast<std::uint32_t>(numbers.line()));
    if (nodes < 0 || used >= size || static_cast<std::uint64_t>(nodes) >= size - used)
      numbers.fail(fmt::format("cell {} has {} points", c, nodes), fmt::format("{} numbers for all cells", size));
    for (std::int64_t k = 0; k < nodes; ++k)
      cells.all_points.push_back(numbers.integer(Scalar::int32, {"a point of cell", c}));
    cells.start.push_back(static_cast<std::int64_t>(cells.all_points.size()));
    used += 1 + static_cast<std::uint64_t>(nodes);
  }
  if (used != size)
    numbers.fail(fmt::format("the cells have {} numbers", used), fmt::format("{}, as declared after CELLS", size));
}

/// Version 5: the start of each cell and the end of the last; then the points of all cells.
void read_offsets(TextScanner& scan, FileNumbers& numbers, std::uint64_t count, std::uint64_t size,
                  VtkLegacyCells& cells) {
  scan.keyword("OFFSETS", LetterCase::any);
  const Scalar offset_type = read_vtk_legacy_type(scan, "the type of the offsets");
  numbers.begin();
  cells.start.clear();
  for (std::uint64_t c = 0; c < count; ++c) {
    const std::int64_t offset = numbers.integer(offset_type, {"the offset of cell", c});
    const std::int64_t least = cells.start.empty() ? 0 : cells.start.back();
    if (offset < least || static_cast<std::uint64_t>(offset) > size || (c == 0 && offset != 0))
      numbers.fail(fmt::format("the offset of cell {} is {}", c, offset),
                   fmt::format("offsets that grow from 0 to {}", size));
    cells.start.push_back(offset);
  }
  if (cells.start.empty()) cells.start.push_back(0);
  if (static_cast<std::uint64_t>(cells.start.back()) != size)
    numbers.fail(fmt::format("the last offset is {}", cells.start.back()),
                 fmt::format("{}, the length of CONNECTIVITY", size));

  scan.keyword("CONNECTIVITY", LetterCase::any);
  const Scalar type = read_vtk_legacy_type(scan, "the type of the connectivity");
  numbers.begin();
  cells.all_points.reserve(numbers.plausible(size, size_of(type), 2));
  cells.lines.resize(cells.count());
  for (std::size_t c = 0; c < cells.count(); ++c)
    for (std::int64_t k = cells.start[c]; k < cells.start[c + 1]; ++k) {
      cells.all_points.push_back(numbers.integer(type, {"a point of cell", c}));
      cells.lines[c] = static_cast<std::uint32_t>(numbers.line());
    }
}

}  // namespace

void VtkLegacyCells::read(TextScanner& scan, FileNumbers& numbers, std::string_view keyword, bool has_offsets) {
  if (found) scan.fail(fmt::format("found {} again", keyword), "one list of cells");
  found = true;
  const std::uint64_t number = scan.count("the number of cells");
  const std::uint64_t size = scan.count("the size of the list of cells");
  has_offsets ? read_offsets(scan, numbers, number, size, *this) : read_lists(numbers, number, size, *this);
}

}  // namespace dartboard
