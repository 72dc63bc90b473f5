#include <fmt/format.h>

#include <vector>

#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/formats/vtk_cells.h"
#include "core/meshes/formats/vtk_legacy_data.h"
#include "core/meshes/formats/vtk_legacy_types.h"

namespace dartboard {
namespace {

/// The cells of the file, whose types come after them.
struct CellList {
  std::vector<std::int64_t> start{0}, points;
  std::vector<std::uint32_t> lines;  // of each cell
  bool found = false;

  std::size_t count() const { return start.size() - 1; }
};

void read_points(TextScanner& scan, FileNumbers& numbers, MeshBuilder& builder) {
  if (builder.point_count() != 0) scan.fail("found POINTS again", "one list of points");
  const std::uint64_t count = scan.count("the number of points");
  const Scalar type = read_vtk_legacy_type(scan, "the type of the coordinates");
  numbers.begin();
  builder.reserve_points(numbers.plausible(count, size_of(type), 6));
  for (std::uint64_t i = 0; i < count; ++i) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = numbers.real(type, {"a coordinate of point", i});
    builder.add_point(i, x, numbers.line());
  }
}

/// Versions 2 to 4: each cell after the number of its points; `size` numbers altogether.
void read_cells(FileNumbers& numbers, std::uint64_t count, std::uint64_t size, CellList& cells) {
  numbers.begin();
  cells.points.reserve(numbers.plausible(size, 4, 2));
  std::uint64_t used = 0;
  for (std::uint64_t c = 0; c < count; ++c) {
    const std::int64_t nodes = numbers.integer(Scalar::int32, {"the number of points of cell", c});
    cells.lines.push_back(static_cast<std::uint32_t>(numbers.line()));
    if (nodes < 0 || used >= size || static_cast<std::uint64_t>(nodes) >= size - used)
      numbers.fail(fmt::format("cell {} has {} points", c, nodes), fmt::format("{} numbers for all cells", size));
    for (std::int64_t k = 0; k < nodes; ++k)
      cells.points.push_back(numbers.integer(Scalar::int32, {"a point of cell", c}));
    cells.start.push_back(static_cast<std::int64_t>(cells.points.size()));
    used += 1 + static_cast<std::uint64_t>(nodes);
  }
  if (used != size)
    numbers.fail(fmt::format("the cells have {} numbers", used), fmt::format("{}, as declared after CELLS", size));
}

/// Version 5: where each cell starts and, at last, ends; then the points of all cells.
void read_offsets(TextScanner& scan, FileNumbers& numbers, std::uint64_t count, std::uint64_t size, CellList& cells) {
  scan.keyword("OFFSETS");
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

  scan.keyword("CONNECTIVITY");
  const Scalar type = read_vtk_legacy_type(scan, "the type of the connectivity");
  numbers.begin();
  cells.points.reserve(numbers.plausible(size, size_of(type), 2));
  cells.lines.resize(cells.count());
  for (std::size_t c = 0; c < cells.count(); ++c)
    for (std::int64_t k = cells.start[c]; k < cells.start[c + 1]; ++k) {
      cells.points.push_back(numbers.integer(type, {"a point of cell", c}));
      cells.lines[c] = static_cast<std::uint32_t>(numbers.line());
    }
}

void read_types(TextScanner& scan, FileNumbers& numbers, const CellList& cells, VtkCellPlaces& places,
                MeshBuilder& builder) {
  const std::uint64_t count = scan.count("the number of cell types");
  if (count != cells.count())
    scan.fail(fmt::format("found {} cell types", count), fmt::format("{}, one for each of the CELLS", cells.count()));
  numbers.begin();
  for (std::size_t c = 0; c < cells.count(); ++c) {
    const std::int64_t type = numbers.integer(Scalar::int32, {"the type of cell", c});
    const auto first = static_cast<std::size_t>(cells.start[c]), end = static_cast<std::size_t>(cells.start[c + 1]);
    places.mark(builder);
    add_vtk_cell(builder, type, std::span(cells.points).subspan(first, end - first),
                 {.line = cells.lines[c], .cell = c, .first_point = 0, .point_count = builder.point_count()});
  }
  places.mark(builder);
}

/// The four lines at the head of the file; returns the version.
std::string read_header(TextScanner& scan, FileNumbers& numbers) {
  const std::string_view first = scan.rest_of_line();
  constexpr std::string_view magic = "# vtk DataFile Version ";
  if (!first.starts_with(magic)) scan.fail(fmt::format("found {}", in_quotes(first)), "'# vtk DataFile Version x.y'");
  const std::string version(first.substr(magic.size()));
  if (version.empty() || version[0] < '1' || version[0] > '5' || (version.size() > 1 && version[1] != '.'))
    scan.fail(fmt::format("version {}", in_quotes(version)), "version 1.0 to 5.1");
  scan.rest_of_line();  // the title, which may be anything
  const std::string_view encoding = scan.token("the word ASCII or BINARY");
  if (encoding == "BINARY") numbers.set_binary(true);
  if (encoding != "ASCII" && encoding != "BINARY")
    scan.fail(fmt::format("found {}", in_quotes(encoding)), "the word ASCII or BINARY");
  scan.keyword("DATASET");
  const std::string_view dataset = scan.token("the kind of data set");
  if (dataset != "UNSTRUCTURED_GRID")
    scan.fail(fmt::format("found the data set {}", in_quotes(dataset)), "UNSTRUCTURED_GRID");
  return version;
}

}  // namespace

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  FileNumbers numbers(scan);
  const std::string version = read_header(scan, numbers);
  CellList cells;
  VtkCellPlaces places;
  bool has_points = false, has_types = false;
  while (!(has_points && has_types)) {
    const std::string_view keyword = scan.token("POINTS, CELLS and CELL_TYPES");
    if (keyword == "POINTS") {
      read_points(scan, numbers, builder);
      has_points = true;
    } else if (keyword == "CELLS") {
      if (cells.found) scan.fail("found CELLS again", "one list of cells");
      const std::uint64_t count = scan.count("the number of cells");
      const std::uint64_t size = scan.count("the size of the list of cells");
      version[0] == '5' ? read_offsets(scan, numbers, count, size, cells) : read_cells(numbers, count, size, cells);
      cells.found = true;
    } else if (keyword == "CELL_TYPES") {
      if (!cells.found || !has_points) scan.fail("found CELL_TYPES", "POINTS and CELLS before it");
      read_types(scan, numbers, cells, places, builder);
      has_types = true;
    } else if (keyword == "METADATA") {
      skip_vtk_metadata(scan);
    } else if (keyword == "FIELD") {
      skip_vtk_field(scan, numbers);
    } else {
      scan.fail(fmt::format("found {}", in_quotes(keyword)), "POINTS, CELLS, CELL_TYPES, METADATA or FIELD");
    }
  }
  read_vtk_legacy_data(scan, numbers, places, builder);
  return fmt::format("legacy VTK {}{}", version, numbers.is_binary() ? " binary" : "");
}

}  // namespace dartboard
