#include <fmt/format.h>

#include <array>
#include <span>

#include "core/meshes/formats/medit_sections.h"
#include "core/meshes/formats/mesh_formats.h"

namespace dartboard {
namespace {

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
    "EdgesP2Ordering",
    "TrianglesP2Ordering",
    "QuadrilateralsQ2Ordering",
    "TetrahedraP2Ordering",
    "PyramidsP2Ordering",
    "PrismsP2Ordering",
    "HexahedraQ2Ordering",
    "SubDomainFromMesh",
    "SubDomainFromGeom",
    "AngleOfCornerBound",
    "BoundingBox",
    "Geometry",
    "Identifier",
    "Iterations",
    "Time",
    "SolAtVertices",
    "SolAtEdges",
    "SolAtTriangles",
    "SolAtQuadrilaterals",
    "SolAtTetrahedra",
    "SolAtPyramids",
    "SolAtPrisms",
    "SolAtHexahedra",
    "VertexOnGeometricVertex",
    "VertexOnGeometricEdge",
};

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

bool starts_a_word(std::string_view token) {
  return !token.empty() && ((token[0] >= 'A' && token[0] <= 'Z') || (token[0] >= 'a' && token[0] <= 'z'));
}

void skip_section(TextScanner& scan) {
  while (!scan.at_end() && !starts_a_word(scan.peek())) scan.token("the rest of a section");
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
    } else if (const MeditSection* const cells = medit_section(keyword)) {
      read_cells(scan, *cells, builder);
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
