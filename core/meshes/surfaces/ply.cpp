#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "core/base/counted.h"
#include "core/meshes/bytes/file_numbers.h"
#include "core/meshes/formats/triangle_strip.h"
#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

struct Property {
  std::string name;
  Scalar type = Scalar::int32;
  std::optional<Scalar> length = {};  // of the number before a list
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties = {};

  bool is_vertex() const { return name == "vertex"; }
  bool is_face() const { return name == "face"; }
  bool is_strips() const { return name == "tristrips"; }
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

Scalar read_type(TextScanner& scan) {
  const std::string_view name = scan.token("the type of a property");
  if (name == "char" || name == "int8") return Scalar::int8;
  if (name == "uchar" || name == "uint8") return Scalar::uint8;
  if (name == "short" || name == "int16") return Scalar::int16;
  if (name == "ushort" || name == "uint16") return Scalar::uint16;
  if (name == "int" || name == "int32") return Scalar::int32;
  if (name == "uint" || name == "uint32") return Scalar::uint32;
  if (name == "int64") return Scalar::int64;
  if (name == "uint64") return Scalar::uint64;
  if (name == "float" || name == "float32") return Scalar::float32;
  if (name != "double" && name != "float64")
    scan.fail(fmt::format("the type {}", in_quotes(name)), "char, short, int, float, double or the like");
  return Scalar::float64;
}

void read_property(TextScanner& scan, Header& header) {
  if (header.elements.empty()) scan.fail("found property", "an element before it");
  Property property{};
  if (scan.peek() == "list") {
    scan.token("list");
    property.length = read_type(scan);
    if (is_real(*property.length)) scan.fail("the length of a list is a real number", "an integer type");
  }
  property.type = read_type(scan);
  property.name = scan.token("the name of a property");
  header.elements.back().properties.push_back(std::move(property));
}

Header read_header(TextScanner& scan) {
  Header header;
  scan.keyword("ply");
  for (;;) {
    const std::string_view word = scan.token("a line of the header, or end_header");
    if (word == "end_header") break;
    if (word == "format") {
      header.format = scan.token("the format");
      if (header.format != "ascii" && header.format != "binary_little_endian" && header.format != "binary_big_endian")
        scan.fail(fmt::format("the format {}", in_quotes(header.format)),
                  "ascii, binary_little_endian or binary_big_endian");
      scan.token("the version of the format");
    } else if (word == "element") {
      std::string name(scan.token("the name of an element"));
      header.elements.push_back({.name = std::move(name), .count = scan.count("the number of elements")});
    } else if (word == "property") {
      read_property(scan, header);
    } else if (word == "comment" || word == "obj_info") {
      scan.rest_of_line();
    } else {
      scan.fail(fmt::format("found {}", in_quotes(word)), "format, element, property, comment or end_header");
    }
  }
  if (header.format.empty()) scan.fail("the header has no format", "a line format before end_header");
  return header;
}

bool is_axis(const Property& property) {
  return property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
}

/// Whether vertices have a property z; those without it are in the plane.
bool check_vertex(const TextScanner& scan, const Element& element) {
  std::array<int, 3> axes{};
  bool are_numbers = true;
  for (const Property& property : element.properties) {
    if (!is_axis(property)) continue;
    ++axes[static_cast<std::size_t>(property.name[0] - 'x')];
    are_numbers = are_numbers && !property.length;
  }
  if (axes[0] != 1 || axes[1] != 1 || axes[2] > 1 || !are_numbers)
    scan.fail("vertices without one property each of x, y and z", "three coordinates, or x and y in the plane");
  return axes[2] == 1;
}

void read_vertex(FileNumbers& numbers, const Element& element, MeshBuilder& builder) {
  const std::uint64_t number = builder.point_count();
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (const Property& property : element.properties) {
    if (property.length)
      numbers.skip(property.type, numbers.count(*property.length, "the length of a list"), "a property of a vertex");
    else if (is_axis(property))
      x[property.name[0] - 'x'] = numbers.real(property.type, {"a coordinate of vertex", number});
    else
      numbers.skip(property.type, 1, "a property of a vertex");
  }
  builder.add_point(number, x, numbers.line());
}

/// The list that has the corners of a face, or the points of a strip: the one of integers or, among several of these,
/// the one of a usual name.
const Property& corners_of(const TextScanner& scan, const Element& element) {
  std::vector<const Property*> lists;
  for (const Property& property : element.properties)
    if (property.length && !is_real(property.type)) lists.push_back(&property);
  if (lists.size() == 1) return *lists.front();
  const std::string_view usual[] = {"vertex_indices", "vertex_index"};
  for (const Property* list : lists)
    if (std::ranges::find(usual, list->name) != std::end(usual)) return *list;
  scan.fail(
      fmt::format("elements {} with {} lists of integers", in_quotes(element.name), lists.size()),
      fmt::format("one with the numbers of points, or several of which one is named {} or {}", usual[0], usual[1]));
}

/// The values of one list of an element; its other properties are skipped.
template <class Take>
void read_list(FileNumbers& numbers, const Element& element, const Property& list, const Take& take) {
  for (const Property& property : element.properties) {
    const std::uint64_t length = property.length ? numbers.count(*property.length, "the length of a list") : 1;
    if (&property != &list)
      numbers.skip(property.type, length, "a property");
    else
      for (std::uint64_t k = 0; k < length; ++k) take();
  }
}

void read_faces(FileNumbers& numbers, const Element& element, const Property& list, MeshBuilder& builder) {
  std::vector<std::uint64_t> corners;
  for (std::uint64_t k = 0; k < element.count; ++k) {
    corners.clear();
    std::size_t line = 0;
    read_list(numbers, element, list, [&] {
      corners.push_back(numbers.count(list.type, {"a corner of face", k}));
      line = numbers.line();
    });
    add_polygon(builder, corners, line);
  }
}

/// The number -1, or any that is negative, ends a strip within a list.
void read_strips(FileNumbers& numbers, const Element& element, const Property& list, MeshBuilder& builder) {
  std::vector<std::uint64_t> strip;
  const auto add = [&] {
    if (strip.size() == 1 || strip.size() == 2)
      numbers.fail(fmt::format("a triangle strip with {}", counted(strip.size(), "point")), "3 points or more");
    for_each_triangle(std::span<const std::uint64_t>(strip),
                      [&](const auto& corners) { builder.add_cell(CellKind::triangle, corners, numbers.line()); });
    strip.clear();
  };
  for (std::uint64_t k = 0; k < element.count; ++k) {
    read_list(numbers, element, list, [&] {
      const std::int64_t point = numbers.integer(list.type, {"a point of strip", k});
      point < 0 ? add() : strip.push_back(static_cast<std::uint64_t>(point));
    });
    add();
  }
}

void skip_elements(FileNumbers& numbers, const Element& element, MeshBuilder& builder) {
  if (element.count == 0) return;
  if (element.name == "edge")
    builder.skip(1, element.count);
  else
    builder.add_notice(fmt::format("left out {} of name {}: only vertex, face and tristrips are read",
                                   counted(element.count, "element"), in_quotes(element.name)));
  if (element.properties.empty()) return;
  const Property none;
  for (std::uint64_t k = 0; k < element.count; ++k) read_list(numbers, element, none, [] {});
}

void read_elements(const TextScanner& scan, FileNumbers& numbers, const Element& element, MeshBuilder& builder) {
  if (element.is_vertex())
    for (std::uint64_t k = 0; k < element.count; ++k) read_vertex(numbers, element, builder);
  else if (element.count != 0 && element.is_face())
    read_faces(numbers, element, corners_of(scan, element), builder);
  else if (element.count != 0 && element.is_strips())
    read_strips(numbers, element, corners_of(scan, element), builder);
  else
    skip_elements(numbers, element, builder);
}

}  // namespace

std::string read_ply(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file());
  const Header header = read_header(scan);
  FileNumbers numbers(scan);
  if (header.format != "ascii") {
    numbers.set_binary(header.format == "binary_big_endian");
    numbers.begin();
  }
  std::uint64_t in_the_plane = 0;
  for (const Element& element : header.elements) {
    if (element.is_vertex() && !check_vertex(scan, element)) in_the_plane += element.count;
    read_elements(scan, numbers, element, builder);
  }
  if (!scan.at_end()) {
    const auto extra = scan.token("nothing");
    scan.fail(fmt::format("{} follows the last element", in_quotes(extra)), "as many elements as the header announces");
  }
  builder.notice_plane(in_the_plane);
  return header.format == "ascii" ? "PLY" : "PLY " + header.format.substr(0, header.format.rfind('_'));
}

}  // namespace dartboard
