#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/formats/vtk_cells.h"

namespace dartboard {
namespace {

/// The cells of the file, whose types come after them.
struct CellList {
  std::vector<std::int64_t> start{0}, points;
  std::vector<std::uint32_t> lines;  // of each cell
  bool found = false;

  std::size_t count() const { return start.size() - 1; }
};

void read_points(TextScanner& scan, MeshBuilder& builder) {
  if (builder.point_count() != 0) scan.fail("found POINTS again", "one list of points");
  const std::uint64_t count = scan.count("the number of points");
  scan.token("the type of the coordinates");
  builder.reserve_points(scan.plausible(count, 6));
  for (std::uint64_t i = 0; i < count; ++i) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = scan.real({"a coordinate of point", i});
    builder.add_point(i, x, scan.line());
  }
}

/// Versions 2 to 4: each cell after the number of its points; `size` numbers altogether.
void read_cells(TextScanner& scan, std::uint64_t count, std::uint64_t size, CellList& cells) {
  cells.points.reserve(scan.plausible(size, 2));
  std::uint64_t used = 0;
  for (std::uint64_t c = 0; c < count; ++c) {
    const std::uint64_t nodes = scan.count({"the number of points of cell", c});
    cells.lines.push_back(static_cast<std::uint32_t>(scan.line()));
    if (nodes >= size - used || used >= size)
      scan.fail(fmt::format("cell {} has {} points", c, nodes), fmt::format("{} numbers for all cells", size));
    for (std::uint64_t k = 0; k < nodes; ++k) cells.points.push_back(scan.integer({"a point of cell", c}));
    cells.start.push_back(static_cast<std::int64_t>(cells.points.size()));
    used += 1 + nodes;
  }
  if (used != size)
    scan.fail(fmt::format("the cells have {} numbers", used), fmt::format("{}, as declared after CELLS", size));
}

/// Version 5: where each cell starts and, at last, ends; then the points of all cells.
void read_offsets(TextScanner& scan, std::uint64_t count, std::uint64_t size, CellList& cells) {
  scan.keyword("OFFSETS");
  scan.token("the type of the offsets");
  cells.start.clear();
  for (std::uint64_t c = 0; c < count; ++c) {
    const std::int64_t offset = scan.integer({"the offset of cell", c});
    const std::int64_t least = cells.start.empty() ? 0 : cells.start.back();
    if (offset < least || static_cast<std::uint64_t>(offset) > size || (c == 0 && offset != 0))
      scan.fail(fmt::format("the offset of cell {} is {}", c, offset),
                fmt::format("offsets that grow from 0 to {}", size));
    cells.start.push_back(offset);
  }
  if (cells.start.empty()) cells.start.push_back(0);
  if (static_cast<std::uint64_t>(cells.start.back()) != size)
    scan.fail(fmt::format("the last offset is {}", cells.start.back()),
              fmt::format("{}, the length of CONNECTIVITY", size));

  scan.keyword("CONNECTIVITY");
  scan.token("the type of the connectivity");
  cells.points.reserve(scan.plausible(size, 2));
  cells.lines.resize(cells.count());
  for (std::size_t c = 0; c < cells.count(); ++c)
    for (std::int64_t k = cells.start[c]; k < cells.start[c + 1]; ++k) {
      cells.points.push_back(scan.integer({"a point of cell", c}));
      cells.lines[c] = static_cast<std::uint32_t>(scan.line());
    }
}

void read_types(TextScanner& scan, const CellList& cells, MeshBuilder& builder) {
  const std::uint64_t count = scan.count("the number of cell types");
  if (count != cells.count())
    scan.fail(fmt::format("found {} cell types", count), fmt::format("{}, one for each of the CELLS", cells.count()));
  for (std::size_t c = 0; c < cells.count(); ++c) {
    const std::int64_t type = scan.integer({"the type of cell", c});
    const auto first = static_cast<std::size_t>(cells.start[c]), end = static_cast<std::size_t>(cells.start[c + 1]);
    add_vtk_cell(builder, type, std::span(cells.points).subspan(first, end - first),
                 {.line = cells.lines[c], .cell = c, .first_point = 0, .point_count = builder.point_count()});
  }
}

/// The four lines at the head of the file; returns the version.
std::string read_header(TextScanner& scan) {
  const std::string_view first = scan.rest_of_line();
  constexpr std::string_view magic = "# vtk DataFile Version ";
  if (!first.starts_with(magic)) scan.fail(fmt::format("found {}", in_quotes(first)), "'# vtk DataFile Version x.y'");
  const std::string version(first.substr(magic.size()));
  if (version.empty() || version[0] < '1' || version[0] > '5' || (version.size() > 1 && version[1] != '.'))
    scan.fail(fmt::format("version {}", in_quotes(version)), "version 1.0 to 5.1");
  scan.rest_of_line();  // the title, which may be anything
  const std::string_view encoding = scan.token("the word ASCII");
  if (encoding == "BINARY") scan.fail("found a BINARY file", "the word ASCII: save the mesh as text");
  if (encoding != "ASCII") scan.fail(fmt::format("found {}", in_quotes(encoding)), "the word ASCII");
  scan.keyword("DATASET");
  const std::string_view dataset = scan.token("the kind of data set");
  if (dataset != "UNSTRUCTURED_GRID")
    scan.fail(fmt::format("found the data set {}", in_quotes(dataset)), "UNSTRUCTURED_GRID");
  return version;
}

/// METADATA ends with an empty line, and a FIELD with its last value: neither matters, so go on to the next keyword.
void skip_block(TextScanner& scan) {
  constexpr std::string_view keywords[] = {"POINTS", "CELLS",      "CELL_TYPES", "METADATA",
                                           "FIELD",  "POINT_DATA", "CELL_DATA"};
  while (!scan.at_end() && std::ranges::find(keywords, scan.peek()) == std::end(keywords))
    scan.token("the rest of a block");
}

}  // namespace

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  const std::string version = read_header(scan);
  CellList cells;
  bool has_points = false, has_types = false;
  while (!(has_points && has_types)) {
    const std::string_view keyword = scan.token("POINTS, CELLS and CELL_TYPES");
    if (keyword == "POINTS") {
      read_points(scan, builder);
      has_points = true;
    } else if (keyword == "CELLS") {
      if (cells.found) scan.fail("found CELLS again", "one list of cells");
      const std::uint64_t count = scan.count("the number of cells");
      const std::uint64_t size = scan.count("the size of the list of cells");
      version[0] == '5' ? read_offsets(scan, count, size, cells) : read_cells(scan, count, size, cells);
      cells.found = true;
    } else if (keyword == "CELL_TYPES") {
      if (!cells.found || !has_points) scan.fail("found CELL_TYPES", "POINTS and CELLS before it");
      read_types(scan, cells, builder);
      has_types = true;
    } else if (keyword == "METADATA" || keyword == "FIELD") {
      skip_block(scan);
    } else {
      scan.fail(fmt::format("found {}", in_quotes(keyword)), "POINTS, CELLS, CELL_TYPES, METADATA or FIELD");
    }
  }
  return fmt::format("legacy VTK {}", version);
}

}  // namespace dartboard
