#include <fmt/format.h>

#include <optional>
#include <span>
#include <vector>

#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/formats/vtk_cells.h"
#include "core/meshes/formats/vtu_array.h"

namespace dartboard {
namespace {

struct VtuFile {
  const std::string& name;
  std::vector<XmlElement> elements;
  VtuEncoding encoding;
};

/// The parts of one <Piece> that make a mesh.
struct Piece {
  std::size_t line = 0;
  std::uint64_t points = 0, cells = 0;
  std::optional<VtuArray> coordinates = {}, connectivity = {}, offsets = {}, types = {};
  std::vector<VtuArray> tags = {};
};

std::uint64_t count_attribute(const XmlElement& tag, std::string_view key, const std::string& file) {
  const std::string wanted = fmt::format("<{} {}=\"a number\">", tag.name, key);
  const auto value = tag.attribute(key);
  if (!value) fail_at(file, tag.line, fmt::format("<{}> has no {}", tag.name, key), wanted);
  TextScanner scan(*value, file, TextScanner::no_comment, tag.line);
  return scan.count(wanted.c_str());
}

VtuEncoding read_encoding(const XmlElement& tag, const std::string& file) {
  const auto type = tag.attribute("type").value_or("");
  if (tag.name != "VTKFile" || type != "UnstructuredGrid")
    fail_at(file, tag.line, fmt::format("found <{}> of type {}", in_quotes(tag.name), in_quotes(type)),
            "<VTKFile type=\"UnstructuredGrid\">");
  const auto header = tag.attribute("header_type").value_or("UInt32");
  if (header != "UInt32" && header != "UInt64")
    fail_at(file, tag.line, fmt::format("<VTKFile> has the header_type {}", in_quotes(header)), "UInt32 or UInt64");
  return {.big_endian = tag.attribute("byte_order") == "BigEndian",
          .header_bytes = header == "UInt32" ? std::size_t{4} : std::size_t{8},
          .compressor = std::string(tag.attribute("compressor").value_or(""))};
}

/// The data begin after an underscore. Raw ones are no XML, so the end is looked for from behind.
VtuAppended read_appended(const VtuFile& file, const XmlElement& tag) {
  const auto encoding = tag.attribute("encoding").value_or("base64");
  if (encoding != "raw" && encoding != "base64")
    fail_at(file.name, tag.line, fmt::format("<AppendedData> has the encoding {}", in_quotes(encoding)),
            "raw or base64");
  const std::size_t begin = tag.text.find_first_not_of(" \t\r\n");
  if (begin == tag.text.npos || tag.text[begin] != '_')
    fail_at(file.name, tag.text_line, "<AppendedData> does not begin with _", "an underscore before the data");
  const std::size_t end = tag.text.rfind("</AppendedData");
  if (end == tag.text.npos || end < begin)
    fail_at(file.name, tag.line, "<AppendedData> has no end", "</AppendedData> after the data");
  return {.data = tag.text.substr(begin + 1, end - begin - 1), .is_raw = encoding == "raw"};
}

/// Keep the array if it is one of the four of a mesh, or whole numbers of cells; others, results for instance, may be
/// in any format.
void take_array(Piece& piece, const XmlElement& tag, std::string_view parent, const std::string& file) {
  const auto key = tag.attribute("Name").value_or("");
  std::optional<VtuArray>* slot = nullptr;
  if (parent == "Points") slot = &piece.coordinates;
  if (parent == "Cells" && key == "connectivity") slot = &piece.connectivity;
  if (parent == "Cells" && key == "offsets") slot = &piece.offsets;
  if (parent == "Cells" && key == "types") slot = &piece.types;
  if (parent == "CellData" && !key.empty() && tag.attribute("NumberOfComponents").value_or("1") == "1")
    if (const auto type = scalar_of_vtu(tag.attribute("type").value_or("")); type && !is_real(*type))
      piece.tags.push_back({.tag = &tag, .name = std::string(key)});
  if (slot == nullptr) return;
  const std::string name(slot == &piece.coordinates ? "Points" : key);
  if (slot->has_value()) fail_at(file, tag.line, fmt::format("found <DataArray> {} again", in_quotes(name)), "it once");
  *slot = VtuArray{.tag = &tag, .name = name};
}

const VtuArray& required(const std::optional<VtuArray>& array, const Piece& piece, std::string_view name,
                         const std::string& file) {
  if (!array) fail_at(file, piece.line, fmt::format("the <Piece> has no <DataArray> '{}'", name), "one");
  return *array;
}

void check_size(const VtuArray& array, std::size_t found, std::uint64_t expected, const std::string& file) {
  if (found != expected)
    fail_at(file, array.tag->line, fmt::format("<DataArray> {} has {} values", in_quotes(array.name), found),
            fmt::format("{}", expected));
}

void add_points(const VtuFile& file, const Piece& piece, MeshBuilder& builder) {
  const std::uint64_t first_point = builder.point_count();
  const VtuArray& array = required(piece.coordinates, piece, "Points", file.name);
  if (array.tag->attribute("NumberOfComponents").value_or("3") != "3")
    fail_at(file.name, array.tag->line, "<DataArray> 'Points' has not 3 components", "NumberOfComponents=\"3\"");
  // the declared counts are only compared with, never allocated for
  const auto x = real_values(array, file.encoding, file.name);
  if (x.size() % 3 != 0 || x.size() / 3 != piece.points)
    fail_at(file.name, array.tag->line, fmt::format("<DataArray> 'Points' has {} values", x.size()),
            fmt::format("three for each of the {} points", piece.points));
  builder.reserve_points(x.size() / 3);
  for (std::size_t p = 0; p < x.size() / 3; ++p)
    builder.add_point(first_point + p, {x[3 * p], x[3 * p + 1], x[3 * p + 2]}, array.tag->line);
}

void add_cells(const VtuFile& file, const Piece& piece, MeshBuilder& builder) {
  const std::uint64_t first_point = builder.point_count() - piece.points;
  const VtuArray& connectivity_array = required(piece.connectivity, piece, "connectivity", file.name);
  const VtuArray& offsets_array = required(piece.offsets, piece, "offsets", file.name);
  const VtuArray& types_array = required(piece.types, piece, "types", file.name);
  const auto connectivity = integer_values(connectivity_array, file.encoding, file.name);
  const auto offsets = integer_values(offsets_array, file.encoding, file.name);
  const auto types = integer_values(types_array, file.encoding, file.name);
  check_size(offsets_array, offsets.size(), piece.cells, file.name);
  check_size(types_array, types.size(), piece.cells, file.name);

  VtkCellPlaces places;
  std::int64_t first = 0;
  for (std::size_t c = 0; c < offsets.size(); ++c) {
    const std::int64_t end = offsets[c];
    if (end < first || end > static_cast<std::int64_t>(connectivity.size()))
      fail_at(file.name, offsets_array.tag->line, fmt::format("<DataArray> 'offsets': offset {} is {}", c, end),
              fmt::format("offsets that grow from 0 to {}", connectivity.size()));
    const auto points =
        std::span(connectivity).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
    places.mark(builder);
    add_vtk_cell(
        builder, types[c], points,
        {.line = connectivity_array.tag->line, .cell = c, .first_point = first_point, .point_count = piece.points});
    first = end;
  }
  places.mark(builder);
  check_size(connectivity_array, connectivity.size(), static_cast<std::uint64_t>(first), file.name);
  for (const VtuArray& array : piece.tags) {
    const auto values = integer_values(array, file.encoding, file.name);
    check_size(array, values.size(), piece.cells, file.name);
    places.tag(builder, array.name, values);
  }
}

/// The arrays of the piece whose tag is the element of this number.
Piece find_arrays(const VtuFile& file, std::size_t number) {
  const XmlElement& tag = file.elements[number];
  Piece piece{.line = tag.line,
              .points = count_attribute(tag, "NumberOfPoints", file.name),
              .cells = count_attribute(tag, "NumberOfCells", file.name)};
  std::size_t list = 0;  // <Points>, <Cells> or the like, read last
  for (std::size_t e = number + 1; e < file.elements.size(); ++e) {
    const XmlElement& element = file.elements[e];
    if (element.name == "Piece" && element.parent >= number && element.parent != XmlElement::no_parent)
      fail_at(file.name, element.line, "found a <Piece> inside another", "its end first");
    if (element.parent == number)
      list = e;
    else if (element.parent == XmlElement::no_parent || element.parent < number)
      break;
    else if (element.name == "DataArray" && element.parent == list)
      take_array(piece, element, file.elements[list].name, file.name);
  }
  return piece;
}

}  // namespace

std::string read_vtu(std::string_view text, MeshBuilder& builder) {
  VtuFile file{
      .name = builder.cell_file(), .elements = read_xml(text, builder.cell_file(), "AppendedData"), .encoding = {}};
  file.encoding = read_encoding(file.elements.front(), file.name);
  if (const XmlElement& last = file.elements.back(); last.name == "AppendedData")
    file.encoding.appended = read_appended(file, last);

  std::size_t pieces = 0;
  for (std::size_t e = 0; e < file.elements.size(); ++e) {
    if (file.elements[e].name != "Piece") continue;
    const Piece piece = find_arrays(file, e);
    add_points(file, piece, builder);
    if (piece.cells != 0) add_cells(file, piece, builder);
    ++pieces;
  }
  if (pieces == 0)
    fail_at(file.name, file.elements.back().line, "the file has no <Piece>", "<UnstructuredGrid> with a <Piece>");
  return "VTU";
}

}  // namespace dartboard
