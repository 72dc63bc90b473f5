#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "core/meshes/formats/medit_sections.h"
#include "core/meshes/formats/mesh_formats.h"
#include "core/meshes/text/letter_case.h"

namespace dartboard {
namespace {

void read_vertices(TextScanner& scan, int dimension, MeshBuilder& builder) {
  const std::uint64_t count = scan.count("the number of vertices");
  builder.reserve_points(scan.plausible(count, 6));
  for (std::uint64_t i = 1; i <= count; ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int k = 0; k < dimension; ++k) x[k] = scan.real({"a coordinate of vertex", i});
    const std::size_t line = scan.line();
    scan.integer({"the reference of vertex", i});
    builder.add_point(i, x, line);
  }
}

void read_cells(TextScanner& scan, const MeditSection& section, MeshBuilder& builder) {
  const std::string node = fmt::format("a vertex of {}", section.called());
  const std::string reference = fmt::format("the reference of {}", section.called());
  const std::size_t column = builder.tags().column("reference", true);
  const std::uint64_t count = scan.count("the number of cells");
  std::array<std::uint64_t, 27> points{};
  const auto nodes = std::span(points).first(static_cast<std::size_t>(section.nodes));
  const auto corners = nodes.first(static_cast<std::size_t>(node_count(section.kind)));
  for (std::uint64_t i = 1; i <= count; ++i) {
    for (auto& p : nodes) p = scan.count({node, i});
    const std::size_t line = scan.line();
    builder.tags().set(column, builder.cell_count(), scan.integer({reference, i}));
    builder.add_cell(section.kind, corners, line, section.element);
  }
}

bool is_one_of(std::string_view keyword, std::span<const std::string_view> keywords) {
  return std::ranges::any_of(keywords, [keyword](std::string_view one) { return same_letters(one, keyword); });
}

bool is_word(std::string_view token) {
  const char first = lower(token).front();
  return first >= 'a' && first <= 'z' && !same_letters(token, "nan") && !same_letters(token, "inf");
}

/// Whether a section of which nothing is known may be one of cells: TetrahedraP3, Polygons, or Tetrahedra misspelt, but
/// not TetrahedraP2Ordering, TrianglesOnGeometricTriangles, TriangleReferenceElement, TetrahedraGrain, PrismsGID.
bool may_hold_cells(std::string_view keyword) {
  const std::string word = lower(keyword);
  const auto begins = [&word](std::string_view part) { return word.starts_with(part); };
  const auto has = [&word](std::string_view part) { return word.find(part) != word.npos; };
  return has("polyg") || has("polyh") ||
         (std::ranges::any_of(std::array{"tri", "quad", "tet", "pyr", "prism", "pent", "wedge", "hex"}, begins) &&
          std::ranges::none_of(std::array{"ordering", "ongeomet", "reference", "grain", "colour", "gid"}, has));
}

/// Skip a section of which nothing is kept: numbers and texts in quotes, up to the next word. Texts without quotes,
/// which may have any words, are known by the names of their sections: one text each, or as many as they count.
void skip_section(TextScanner& scan, std::string_view keyword) {
  constexpr std::array<std::string_view, 4> one{"Identifier", "Geometry", "MeshSupportOfVertices",
                                                "IdentityOfMeshSupport"};
  constexpr std::array<std::string_view, 3> counted{"Comments", "IRefGroups", "ReferenceStrings"};
  if (is_one_of(keyword, one)) {
    scan.quoted_or_line("a text");
  } else if (is_one_of(keyword, counted)) {
    for (std::uint64_t left = scan.count("the number of texts"); left > 0; --left) scan.quoted_or_line("a text");
  } else {
    while (!scan.at_end() && !is_word(scan.peek())) {
      if (scan.peek().starts_with('"'))
        scan.quoted_or_line("a text");
      else
        scan.token("a number");
    }
  }
}

/// The binary variant begins with the number 1, in either order of its four bytes.
bool is_binary(std::string_view text) {
  using namespace std::string_view_literals;
  return text.starts_with("\x01\0\0\0"sv) || text.starts_with("\0\0\0\x01"sv);
}

}  // namespace

std::string read_medit(std::string_view text, MeshBuilder& builder) {
  if (is_binary(text)) return read_medit_binary(text, builder);
  TextScanner scan(text, builder.cell_file(), '#');
  scan.keyword("MeshVersionFormatted", LetterCase::any);
  const std::uint64_t version = scan.count("the version of the format");
  if (version > 4) scan.fail(fmt::format("version {}", version), "version 0, 1, 2, 3 or 4");
  scan.keyword("Dimension", LetterCase::any);
  const std::uint64_t dimension = scan.count("the dimension");
  if (dimension != 2 && dimension != 3) scan.fail(fmt::format("dimension {}", dimension), "dimension 2 or 3");

  bool has_vertices = false;
  for (;;) {
    if (scan.at_end()) {
      builder.add_notice("the file ends without the word End: whether further sections were cut off cannot be known");
      break;
    }
    const std::string_view keyword = scan.token("a section");
    if (same_letters(keyword, "End")) break;
    if (same_letters(keyword, "Vertices")) {
      if (has_vertices) scan.fail("found Vertices again", "one section of vertices");
      read_vertices(scan, static_cast<int>(dimension), builder);
      has_vertices = true;
    } else if (const MeditSection* const cells = medit_section(keyword)) {
      read_cells(scan, *cells, builder);
    } else if (same_letters(keyword, "Edges")) {
      const std::uint64_t count = scan.count("the number of edges");
      for (std::uint64_t i = 0; i < 3 * count; ++i) scan.integer("a vertex or the reference of an edge");
      builder.skip(1, count);
    } else if (is_word(keyword) && !may_hold_cells(keyword)) {
      skip_section(scan, keyword);
      builder.skip_section(keyword);
    } else {
      scan.fail(fmt::format("{} is not a section of a mesh", in_quotes(keyword)),
                "Vertices, Triangles, Quadrilaterals, Tetrahedra, Pyramids, Prisms, Hexahedra, Edges or End");
    }
  }
  return fmt::format("Medit {}", version);
}

}  // namespace dartboard
