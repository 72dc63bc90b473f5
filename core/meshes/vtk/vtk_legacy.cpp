#include <fmt/format.h>

#include <algorithm>

#include "core/meshes/text/letter_case.h"
#include "core/meshes/vtk/vtk_cells.h"
#include "core/meshes/vtk/vtk_formats.h"
#include "core/meshes/vtk/vtk_legacy_cells.h"
#include "core/meshes/vtk/vtk_legacy_data.h"
#include "core/meshes/vtk/vtk_legacy_types.h"

namespace dartboard {
namespace {

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

void add_cell(const VtkLegacyCells& cells, std::size_t c, std::int64_t type, VtkCellPlaces& places,
              MeshBuilder& builder) {
  places.mark(builder);
  add_vtk_cell(
      builder, type, cells.points(c),
      {.line = cells.lines[c], .cell = places.count(), .first_point = 0, .point_count = builder.point_count()});
}

void read_types(TextScanner& scan, FileNumbers& numbers, const VtkLegacyCells& cells, VtkCellPlaces& places,
                MeshBuilder& builder) {
  const std::uint64_t count = scan.count("the number of cell types");
  if (count != cells.count())
    scan.fail(fmt::format("found {} cell types", count), fmt::format("{}, one for each of the CELLS", cells.count()));
  numbers.begin();
  for (std::size_t c = 0; c < cells.count(); ++c)
    add_cell(cells, c, numbers.integer(Scalar::int32, {"the type of cell", c}), places, builder);
  places.mark(builder);
}

struct Header {
  std::string version;
  bool is_grid;  // false: polygons

  bool has_offsets() const { return version[0] == '5'; }
};

/// Read the four lines at the head of the file.
Header read_header(TextScanner& scan, FileNumbers& numbers) {
  const std::string_view first = scan.rest_of_line();
  constexpr std::string_view magic = "# vtk DataFile Version ";
  if (!same_letters(first.substr(0, magic.size()), magic))
    scan.fail(fmt::format("found {}", in_quotes(first)), "'# vtk DataFile Version x.y'");
  const std::string version(first.substr(magic.size()));
  if (version.empty() || version[0] < '1' || version[0] > '5' || (version.size() > 1 && version[1] != '.'))
    scan.fail(fmt::format("version {}", in_quotes(version)), "version 1.0 to 5.1");
  scan.rest_of_line();  // the title, which may be anything
  const std::string encoding = upper(scan.token("the word ASCII or BINARY"));
  if (encoding == "BINARY") numbers.set_binary(true);
  if (encoding != "ASCII" && encoding != "BINARY")
    scan.fail(fmt::format("found {}", in_quotes(encoding)), "the word ASCII or BINARY");
  scan.keyword("DATASET", LetterCase::any);
  const std::string dataset = upper(scan.token("the kind of data set"));
  if (dataset != "UNSTRUCTURED_GRID" && dataset != "POLYDATA")
    scan.fail(fmt::format("found the data set {}", in_quotes(dataset)), "UNSTRUCTURED_GRID or POLYDATA");
  return {.version = version, .is_grid = dataset == "UNSTRUCTURED_GRID"};
}

/// Read a keyword that may stand among the lists of either data set; false for any other keyword.
bool read_common(TextScanner& scan, FileNumbers& numbers, std::string_view keyword, MeshBuilder& builder) {
  if (keyword == "POINTS")
    read_points(scan, numbers, builder);
  else if (keyword == "METADATA")
    skip_vtk_metadata(scan);
  else if (keyword == "FIELD")
    skip_vtk_field(scan, numbers);
  else
    return false;
  return true;
}

void read_grid(TextScanner& scan, FileNumbers& numbers, bool has_offsets, VtkCellPlaces& places, MeshBuilder& builder) {
  VtkLegacyCells cells;
  bool has_points = false, has_types = false;
  while (!(has_points && has_types)) {
    const std::string keyword = upper(scan.token("POINTS, CELLS and CELL_TYPES"));
    if (keyword == "POINTS") has_points = true;
    if (keyword == "CELLS") {
      cells.read(scan, numbers, keyword, has_offsets);
    } else if (keyword == "CELL_TYPES") {
      if (!cells.found || !has_points) scan.fail("found CELL_TYPES", "POINTS and CELLS before it");
      read_types(scan, numbers, cells, places, builder);
      has_types = true;
    } else if (!read_common(scan, numbers, keyword, builder)) {
      scan.fail(fmt::format("found {}", in_quotes(keyword)), "POINTS, CELLS, CELL_TYPES, METADATA or FIELD");
    }
  }
}

/// The lists of polygon data, each of one type, in the order in which data of cells count them.
struct PolyList {
  std::string_view keyword;
  std::int64_t type;
  VtkLegacyCells cells = {};
};

/// The lists may be in any order, and each may be missing: they end where data begin, or with the text.
void read_polygons(TextScanner& scan, FileNumbers& numbers, bool has_offsets, VtkCellPlaces& places,
                   MeshBuilder& builder) {
  PolyList lists[] = {{"VERTICES", vtk_poly_vertex},
                      {"LINES", vtk_poly_line},
                      {"POLYGONS", vtk_polygon},
                      {"TRIANGLE_STRIPS", vtk_triangle_strip}};
  while (!scan.at_end() && !same_letters(scan.peek(), "CELL_DATA") && !same_letters(scan.peek(), "POINT_DATA")) {
    const std::string keyword = upper(scan.token("a list"));
    const auto list = std::ranges::find(lists, keyword, &PolyList::keyword);
    if (list != std::end(lists))
      list->cells.read(scan, numbers, keyword, has_offsets);
    else if (!read_common(scan, numbers, keyword, builder))
      scan.fail(fmt::format("found {}", in_quotes(keyword)),
                "POINTS, VERTICES, LINES, POLYGONS, TRIANGLE_STRIPS, METADATA or FIELD");
  }
  for (const PolyList& list : lists)
    for (std::size_t c = 0; c < list.cells.count(); ++c) add_cell(list.cells, c, list.type, places, builder);
  places.mark(builder);
}

}  // namespace

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  FileNumbers numbers(scan);
  const Header header = read_header(scan, numbers);
  VtkCellPlaces places;
  (header.is_grid ? read_grid : read_polygons)(scan, numbers, header.has_offsets(), places, builder);
  read_vtk_legacy_data(scan, numbers, places, builder);
  note_ghost_cells(builder);
  return fmt::format("legacy VTK {}{}{}", header.version, header.is_grid ? "" : " polygons",
                     numbers.is_binary() ? " binary" : "");
}

}  // namespace dartboard
