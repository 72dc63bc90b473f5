#include <fmt/format.h>

#include <optional>
#include <span>
#include <vector>

#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/formats/vtk_cells.h"
#include "core/meshes/formats/vtu_array.h"

namespace dartboard {
namespace {

/// The parts of one <Piece> that make a mesh.
struct Piece {
  std::size_t line = 0;
  std::uint64_t points = 0, cells = 0;
  std::optional<VtuArray> coordinates, connectivity, offsets, types;
};

std::uint64_t count_attribute(const XmlTag& tag, std::string_view key, const std::string& file) {
  const std::string wanted = fmt::format("<{} {}=\"a number\">", tag.name, key);
  const auto value = tag.attribute(key);
  if (!value) fail_at(file, tag.line, fmt::format("<{}> has no {}", tag.name, key), wanted);
  TextScanner scan(*value, file, TextScanner::no_comment, tag.line);
  return scan.count(wanted.c_str());
}

VtuEncoding read_encoding(const XmlTag& tag, const std::string& file) {
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

/// Keep the array if it is one of the four of a mesh; others, of results for instance, may be in any format.
void take_array(Piece& piece, const XmlTag& tag, const XmlScanner& xml, const std::string& file) {
  const auto key = tag.attribute("Name").value_or("");
  std::optional<VtuArray>* slot = nullptr;
  if (xml.parent() == "Points") slot = &piece.coordinates;
  if (xml.parent() == "Cells" && key == "connectivity") slot = &piece.connectivity;
  if (xml.parent() == "Cells" && key == "offsets") slot = &piece.offsets;
  if (xml.parent() == "Cells" && key == "types") slot = &piece.types;
  if (slot == nullptr) return;
  const std::string name(slot == &piece.coordinates ? "Points" : key);
  if (slot->has_value()) fail_at(file, tag.line, fmt::format("found <DataArray> {} again", in_quotes(name)), "it once");
  *slot = VtuArray{.tag = tag, .name = name, .text = xml.text(), .text_line = xml.line()};
}

const VtuArray& required(const std::optional<VtuArray>& array, const Piece& piece, std::string_view name,
                         const std::string& file) {
  if (!array) fail_at(file, piece.line, fmt::format("the <Piece> has no <DataArray> '{}'", name), "one");
  return *array;
}

void check_size(const VtuArray& array, std::size_t found, std::uint64_t expected, const std::string& file) {
  if (found != expected)
    fail_at(file, array.tag.line, fmt::format("<DataArray> '{}' has {} values", array.name, found),
            fmt::format("{}", expected));
}

void finish_piece(const Piece& piece, const VtuEncoding& encoding, MeshBuilder& builder) {
  const std::string& file = builder.cell_file();
  const std::uint64_t first_point = builder.point_count();
  const VtuArray& array = required(piece.coordinates, piece, "Points", file);
  if (array.tag.attribute("NumberOfComponents").value_or("3") != "3")
    fail_at(file, array.tag.line, "<DataArray> 'Points' has not 3 components", "NumberOfComponents=\"3\"");
  // the declared counts are only compared with, never allocated for
  const auto x = real_values(array, encoding, file);
  if (x.size() % 3 != 0 || x.size() / 3 != piece.points)
    fail_at(file, array.tag.line, fmt::format("<DataArray> 'Points' has {} values", x.size()),
            fmt::format("three for each of the {} points", piece.points));
  builder.reserve_points(x.size() / 3);
  for (std::size_t p = 0; p < x.size() / 3; ++p)
    builder.add_point(first_point + p, {x[3 * p], x[3 * p + 1], x[3 * p + 2]}, array.tag.line);
  if (piece.cells == 0) return;

  const VtuArray& connectivity_array = required(piece.connectivity, piece, "connectivity", file);
  const VtuArray& offsets_array = required(piece.offsets, piece, "offsets", file);
  const VtuArray& types_array = required(piece.types, piece, "types", file);
  const auto connectivity = integer_values(connectivity_array, encoding, file);
  const auto offsets = integer_values(offsets_array, encoding, file);
  const auto types = integer_values(types_array, encoding, file);
  check_size(offsets_array, offsets.size(), piece.cells, file);
  check_size(types_array, types.size(), piece.cells, file);

  std::int64_t first = 0;
  for (std::size_t c = 0; c < offsets.size(); ++c) {
    const std::int64_t end = offsets[c];
    if (end < first || end > static_cast<std::int64_t>(connectivity.size()))
      fail_at(file, offsets_array.tag.line, fmt::format("<DataArray> 'offsets': offset {} is {}", c, end),
              fmt::format("offsets that grow from 0 to {}", connectivity.size()));
    const auto points =
        std::span(connectivity).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
    add_vtk_cell(
        builder, types[c], points,
        {.line = connectivity_array.tag.line, .cell = c, .first_point = first_point, .point_count = piece.points});
    first = end;
  }
  check_size(connectivity_array, connectivity.size(), static_cast<std::uint64_t>(first), file);
}

}  // namespace

std::string read_vtu(std::string_view text, MeshBuilder& builder) {
  const std::string& file = builder.cell_file();
  XmlScanner xml(text, file);
  const auto root = xml.next();
  if (!root) fail_at(file, xml.line(), "found no tag", "<VTKFile type=\"UnstructuredGrid\">");
  const VtuEncoding encoding = read_encoding(*root, file);

  std::optional<Piece> piece;
  std::size_t pieces = 0;
  while (const auto tag = xml.next()) {
    if (tag->name == "AppendedData") fail_at(file, tag->line, "found <AppendedData>", "arrays inline, not appended");
    if (tag->name == "Piece" && !tag->closes) {
      if (piece) fail_at(file, tag->line, "found a <Piece> inside another", "its end first");
      piece.emplace();
      piece->line = tag->line;
      piece->points = count_attribute(*tag, "NumberOfPoints", file);
      piece->cells = count_attribute(*tag, "NumberOfCells", file);
      ++pieces;
    } else if (tag->name == "Piece") {
      finish_piece(piece.value(), encoding, builder);
      piece.reset();
    } else if (tag->name == "DataArray" && !tag->closes && piece) {
      take_array(*piece, *tag, xml, file);
    }
  }
  if (pieces == 0) fail_at(file, xml.line(), "the file has no <Piece>", "<UnstructuredGrid> with a <Piece>");
  return "VTU";
}

}  // namespace dartboard
