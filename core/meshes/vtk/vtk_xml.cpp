#include "core/meshes/vtk/vtk_xml.h"

#include <fmt/format.h>

#include <optional>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

constexpr std::string_view grid = "UnstructuredGrid";

VtuEncoding read_encoding(const XmlElement& tag, const std::string& file) {
  const auto type = tag.attribute("type").value_or("");
  if (tag.name != "VTKFile" || type != grid)
    fail_at(file, tag.line, fmt::format("found <{}> of type {}", in_quotes(tag.name), in_quotes(type)),
            fmt::format("<VTKFile type=\"{}\">", grid));
  const auto header = tag.attribute("header_type").value_or("UInt32");
  if (header != "UInt32" && header != "UInt64")
    fail_at(file, tag.line, fmt::format("<VTKFile> has the header_type {}", in_quotes(header)), "UInt32 or UInt64");
  return {.big_endian = tag.attribute("byte_order") == "BigEndian",
          .header_bytes = header == "UInt32" ? std::size_t{4} : std::size_t{8},
          .compressor = std::string(tag.attribute("compressor").value_or(""))};
}

/// The data begin after an underscore. Raw data are not XML, so the end is searched backwards.
VtuAppended read_appended(const VtkXml& file, const XmlElement& tag) {
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

void take_array(VtkPiece& piece, const XmlElement& tag, std::string_view parent, const std::string& file) {
  const auto key = tag.attribute("Name").value_or("");
  if (parent == "CellData" && !key.empty() && tag.attribute("NumberOfComponents").value_or("1") == "1")
    if (const auto type = scalar_of_vtu(tag.attribute("type").value_or("")); type && !is_real(*type))
      piece.tags.push_back({.tag = &tag, .name = std::string(key)});
  if (parent != "Points" && parent != "Cells") return;
  const std::string name(parent == "Points" ? "Points" : key);
  const bool is_new = piece.arrays.try_emplace({parent, name}, VtuArray{.tag = &tag, .name = name}).second;
  if (!is_new) fail_at(file, tag.line, fmt::format("found <DataArray> {} again", in_quotes(name)), "it once");
}

void check_size(const VtuArray& array, std::size_t found, std::uint64_t expected, const std::string& file) {
  if (found != expected)
    fail_at(file, array.tag->line, fmt::format("<DataArray> {} has {} values", in_quotes(array.name), found),
            fmt::format("{}", expected));
}

}  // namespace

VtkXml read_vtk_xml(std::string_view text, const std::string& name) {
  VtkXml file{.name = name, .elements = read_xml(text, name, "AppendedData")};
  file.encoding = read_encoding(file.elements.front(), name);
  if (const XmlElement& last = file.elements.back(); last.name == "AppendedData")
    file.encoding.appended = read_appended(file, last);
  return file;
}

std::vector<std::size_t> VtkXml::pieces() const {
  std::vector<std::size_t> found;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (elements[e].name == "Piece") found.push_back(e);
  if (found.empty())
    fail_at(name, elements.back().line, "the file has no <Piece>", fmt::format("<{}> with a <Piece>", grid));
  return found;
}

std::uint64_t VtkXml::count_attribute(const XmlElement& tag, std::string_view key) const {
  const std::string wanted = fmt::format("<{} {}=\"a number\">", tag.name, key);
  const auto value = tag.attribute(key);
  if (!value) fail_at(name, tag.line, fmt::format("<{}> has no {}", tag.name, key), wanted);
  TextScanner scan(*value, name, TextScanner::no_comment, tag.line);
  return scan.count(wanted.c_str());
}

const VtuArray& VtkPiece::array(std::string_view list, const std::string& key, const VtkXml& file) const {
  const auto at = arrays.find({list, key});
  if (at == arrays.end()) fail_at(file.name, line, fmt::format("the <Piece> has no <DataArray> '{}'", key), "one");
  return at->second;
}

VtkPiece find_vtk_piece(const VtkXml& file, std::size_t number) {
  const XmlElement& tag = file.elements[number];
  VtkPiece piece{.line = tag.line, .points = file.count_attribute(tag, "NumberOfPoints")};
  std::size_t list = 0;  // <Points>, <Cells> or <CellData>, read last
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

std::uint64_t add_vtk_points(const VtkXml& file, const VtkPiece& piece, MeshBuilder& builder) {
  const std::uint64_t first_point = builder.point_count();
  const VtuArray& array = piece.array("Points", "Points", file);
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
  return first_point;
}

std::vector<std::int64_t> read_vtk_integers(const VtkXml& file, const VtuArray& array, std::uint64_t count) {
  auto values = integer_values(array, file.encoding, file.name);
  check_size(array, values.size(), count, file.name);
  return values;
}

VtkXmlCells read_vtk_cells(const VtkXml& file, const VtkPiece& piece, std::uint64_t count) {
  const VtuArray& points = piece.array("Cells", "connectivity", file);
  const VtuArray& ends = piece.array("Cells", "offsets", file);
  VtkXmlCells cells{.line = points.tag->line,
                    .connectivity = integer_values(points, file.encoding, file.name),
                    .offsets = read_vtk_integers(file, ends, count)};
  std::int64_t first = 0;
  for (std::size_t c = 0; c < cells.offsets.size(); ++c) {
    const std::int64_t end = cells.offsets[c];
    if (end < first || end > static_cast<std::int64_t>(cells.connectivity.size()))
      fail_at(file.name, ends.tag->line, fmt::format("<DataArray> 'offsets': offset {} is {}", c, end),
              fmt::format("offsets that grow from 0 to {}", cells.connectivity.size()));
    first = end;
  }
  check_size(points, cells.connectivity.size(), static_cast<std::uint64_t>(first), file.name);
  return cells;
}

void tag_vtk_cells(const VtkXml& file, const VtkPiece& piece, const VtkCellPlaces& places, MeshBuilder& builder) {
  for (const VtuArray& array : piece.tags)
    places.tag(builder, array.name, read_vtk_integers(file, array, places.count()));
}

}  // namespace dartboard
