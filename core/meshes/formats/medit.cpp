#include <fmt/format.h>

#include <array>
#include <optional>
#include <type_traits>

#include "core/meshes/formats/mesh_formats.h"

namespace dartboard {
namespace {

struct Section {
  std::string_view keyword;
  CellKind kind;
};

constexpr Section cell_sections[] = {
    {"Triangles", CellKind::triangle},     {"Quadrilaterals", CellKind::quadrilateral},
    {"Tetrahedra", CellKind::tetrahedron}, {"Pyramids", CellKind::pyramid},
    {"Prisms", CellKind::prism},           {"Pentahedra", CellKind::prism},
    {"Hexahedra", CellKind::hexahedron},   {"Hexaedra", CellKind::hexahedron},
};

struct HigherOrderSection {
  std::string_view keyword, element;
  int dimension;
};

constexpr HigherOrderSection higher_order_sections[] = {
    {"TrianglesP2", "6-node triangle", 2},      {"QuadrilateralsQ2", "9-node quadrilateral", 2},
    {"TetrahedraP2", "10-node tetrahedron", 3}, {"PyramidsP2", "14-node pyramid", 3},
    {"PrismsP2", "18-node prism", 3},           {"HexahedraQ2", "27-node hexahedron", 3},
};

// nothing in them changes the mesh
constexpr std::string_view ignored_sections[] = {
    "Corners",
    "Ridges",
    "RequiredVertices",
    "RequiredEdges",
    "RequiredTriangles",
    "RequiredQuadrilaterals",
    "Normals",
    "NormalAtVertices",
    "NormalAtTriangleVertices",
    "NormalAtQuadrilateralVertices",
    "Tangents",
    "TangentAtVertices",
    "TangentAtEdges",
    "EdgesP2",
    "SubDomainFromMesh",
    "SubDomainFromGeom",
    "AngleOfCornerBound",
    "BoundingBox",
    "Geometry",
    "Identifier",
    "VertexOnGeometricVertex",
    "VertexOnGeometricEdge",
};

template <class Sections>
auto find_section(const Sections& sections, std::string_view keyword) {
  std::optional<std::decay_t<decltype(sections[0])>> found;
  for (const auto& section : sections)
    if (section.keyword == keyword) found = section;
  return found;
}

bool is_ignored(std::string_view keyword) {
  for (std::string_view ignored : ignored_sections)
    if (keyword == ignored) return true;
  return false;
}

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

void read_cells(TextScanner& scan, CellKind kind, MeshBuilder& builder) {
  const std::string kind_name(name(kind));
  const std::string node = fmt::format("a vertex of {}", kind_name);
  const std::string reference = fmt::format("the reference of {}", kind_name);
  const std::uint64_t count = scan.count("the number of cells");
  std::array<std::uint64_t, 8> points{};
  const auto nodes = std::span(points).first(static_cast<std::size_t>(node_count(kind)));
  for (std::uint64_t i = 1; i <= count; ++i) {
    for (auto& p : nodes) p = scan.count({node, i});
    const std::size_t line = scan.line();
    scan.integer({reference, i});
    builder.add_cell(kind, nodes, line);
  }
}

bool starts_a_word(std::string_view token) {
  return !token.empty() && ((token[0] >= 'A' && token[0] <= 'Z') || (token[0] >= 'a' && token[0] <= 'z'));
}

void skip_section(TextScanner& scan) {
  while (!scan.at_end() && !starts_a_word(scan.peek())) scan.token("the rest of a section");
}

}  // namespace

std::string read_medit(std::string_view text, MeshBuilder& builder) {
  TextScanner scan(text, builder.cell_file(), '#');
  scan.keyword("MeshVersionFormatted");
  const std::uint64_t version = scan.count("the version of the format");
  if (version < 1 || version > 4) scan.fail(fmt::format("version {}", version), "version 1, 2, 3 or 4");
  scan.keyword("Dimension");
  const std::uint64_t dimension = scan.count("the dimension");
  if (dimension != 2 && dimension != 3) scan.fail(fmt::format("dimension {}", dimension), "dimension 2 or 3");

  bool has_vertices = false;
  // without End a file may have lost its last sections, and a solid would pass for its surface
  for (;;) {
    const std::string_view keyword = scan.token("a section, or the word End after the last one");
    if (keyword == "End") break;
    if (keyword == "Vertices") {
      if (has_vertices) scan.fail("found Vertices again", "one section of vertices");
      read_vertices(scan, static_cast<int>(dimension), builder);
      has_vertices = true;
    } else if (const auto cells = find_section(cell_sections, keyword)) {
      read_cells(scan, cells->kind, builder);
    } else if (const auto higher = find_section(higher_order_sections, keyword)) {
      if (const std::uint64_t count = scan.count("the number of cells"); count != 0)
        builder.add_higher_order(higher->element, higher->dimension, scan.line(), count);
      skip_section(scan);
    } else if (keyword == "Edges") {
      const std::uint64_t count = scan.count("the number of edges");
      for (std::uint64_t i = 0; i < 3 * count; ++i) scan.integer("a vertex or the reference of an edge");
      builder.skip(1, count);
    } else if (is_ignored(keyword)) {
      skip_section(scan);
    } else {
      scan.fail(fmt::format("{} is not a section of a mesh", in_quotes(keyword)),
                "Vertices, Triangles, Quadrilaterals, Tetrahedra, Pyramids, Prisms, Hexahedra, Edges or End");
    }
  }
  return fmt::format("Medit {}", version);
}

}  // namespace dartboard
