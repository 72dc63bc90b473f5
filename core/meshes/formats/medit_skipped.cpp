#include "core/meshes/formats/medit_skipped.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/meshes/text/letter_case.h"

namespace dartboard {
namespace {

enum class Lines {
  counted,    // a count, and as many lines of `width` numbers
  vectors,    // a count, and as many lines of a coordinate for each axis
  of_points,  // `width` numbers for each vertex, without a count
  any,        // numbers up to the next keyword: the width differs between writers
  text,       // in quotes, or the rest of the line
  texts,      // a count, and as many lines of text
};

struct Skipped {
  std::string_view keyword;
  Lines lines = Lines::any;
  std::uint64_t width = 0;
};

/// nullptr if a keyword is not in the table.
const Skipped* skipped_section(std::string_view keyword) {
  using enum Lines;
  static constexpr Skipped table[] = {
      {"Corners", counted, 1},
      {"Ridges", counted, 1},
      {"RequiredVertices", counted, 1},
      {"RequiredEdges", counted, 1},
      {"RequiredTriangles", counted, 1},
      {"RequiredQuadrilaterals", counted, 1},
      {"RequiredTetrahedra", counted, 1},
      {"RequiredPyramids", counted, 1},
      {"RequiredPrisms", counted, 1},
      {"RequiredHexahedra", counted, 1},
      {"ParallelVertices", counted, 1},
      {"ParallelEdges", counted, 1},
      {"ParallelTriangles", counted, 1},
      {"Normals", vectors},
      {"NormalAtVertices", counted, 2},
      {"NormalAtTriangleVertices", counted, 3},
      {"NormalAtQuadrilateralVertices"},
      {"Tangents", vectors},
      {"TangentAtVertices", counted, 2},
      {"TangentAtEdges", counted, 3},
      {"TangentAtEdgeVertices", counted, 3},
      {"EdgesP2", counted, 4},
      {"EdgesP3", counted, 5},
      {"EdgesP4", counted, 6},
      {"PeriodicVertices", counted, 2},
      {"PeriodicEdges", counted, 2},
      {"PeriodicTriangles", counted, 2},
      {"PeriodicQuadrilaterals", counted, 2},
      {"EdgeOnGeometricEdge", counted, 2},
      {"EdgesOnGeometricEdges", counted, 2},
      {"VertexOnGeometricVertex", counted, 2},
      {"VerticesOnGeometricVertices", counted, 2},
      {"VertexOnGeometricEdge"},
      {"VerticesOnGeometricEdges"},
      {"VerticesOnGeometricTriangles"},
      {"VerticesOnGeometricQuadrilaterals"},
      {"TrianglesOnGeometricTriangles", counted, 2},
      {"TrianglesOnGeometricQuadrilaterals", counted, 2},
      {"QuadrilateralsOnGeometricTriangles", counted, 2},
      {"QuadrilateralsOnGeometricQuadrilaterals", counted, 2},
      {"VertexOnGeometryNode"},
      {"VertexOnGeometryEdge"},
      {"VertexOnGeometryFace"},
      {"EdgeOnGeometryEdge"},
      {"EdgeOnGeometryFace"},
      {"TriangleOnGeometryFace"},
      {"QuadrialteralOnGeometryFace"},  // as libMeshb spells it
      {"QuadrilateralOnGeometryFace"},
      {"MeshOnGeometry"},
      {"VertexOnSupportVertex"},
      {"VertexOnSupportEdge"},
      {"VertexOnSupportTriangle"},
      {"CrackedEdges", counted, 2},
      {"EquivalencedEdges", counted, 2},
      {"SubDomain"},
      {"SubDomainFromMesh"},
      {"SubDomainFromGeom"},
      {"Domains"},
      {"BoundaryLayers", counted, 3},
      {"AngleOfCornerBound"},
      {"MaximalAngleOfCorner"},
      {"BoundingBox"},
      {"hVertices", of_points, 1},
      {"MetricVertices", of_points, 3},
      {"h1h2VpVertices", of_points, 4},
      {"Iterations"},
      {"Time"},
      {"FloatingPointPrecision"},
      {"BezierBasis"},
      {"PrivateTable", counted, 1},
      {"ByteFlow", counted, 1},
      {"CoarseHexahedra", counted, 1},
      {"VerticesColour", counted, 1},
      {"VerticesGrain", counted, 1},
      {"TetrahedraColour", counted, 1},
      {"TetrahedraGrain", counted, 1},
      {"ColorPartitions", counted, 2},
      {"DRefGroups", counted, 3},
      {"Identifier", text},
      {"Geometry", text},
      {"MeshSupportOfVertices", text},
      {"IdentityOfMeshSupport", text},
      {"Comments", texts},
      {"IRefGroups", texts},
      {"ReferenceStrings", texts},
  };
  const auto* const found =
      std::ranges::find_if(table, [&](const Skipped& s) { return same_letters(s.keyword, keyword); });
  return found == std::end(table) ? nullptr : found;
}

/// Families of sections: "SolAtVertices", "HOSolAtEdgesP1NodesPositions", "TetrahedraP2Ordering", "TrianglesGID".
bool is_of_a_family(std::string_view keyword) {
  for (const std::string_view begin : {"SolAt", "DSolAt", "ISolAt", "HOSolAt", "Fault_", "ExtraVerticesAt"})
    if (same_letters(keyword.substr(0, begin.size()), begin)) return true;
  for (const std::string_view end : {"Ordering", "ReferenceElement", "GrainPartitions", "GID"})
    if (keyword.size() >= end.size() && same_letters(keyword.substr(keyword.size() - end.size()), end)) return true;
  return false;
}

bool starts_a_word(std::string_view token) {
  const bool begins_with_a_letter =
      !token.empty() && ((token[0] >= 'A' && token[0] <= 'Z') || (token[0] >= 'a' && token[0] <= 'z'));
  return begins_with_a_letter && !same_letters(token, "nan") && !same_letters(token, "inf");
}

void skip_numbers(TextScanner& scan, std::uint64_t lines, std::uint64_t width, const std::string& wanted) {
  for (std::uint64_t line = 1; line <= lines; ++line)
    for (std::uint64_t k = 0; k < width; ++k) scan.real({wanted, line});
}

}  // namespace

bool skip_medit_section(TextScanner& scan, std::string_view keyword, const MeditSizes& sizes) {
  const Skipped* const found = skipped_section(keyword);
  if (found == nullptr && !is_of_a_family(keyword)) return false;
  const Skipped section = found == nullptr ? Skipped{.keyword = keyword} : *found;
  const std::string wanted = fmt::format("a number of {}", keyword),
                    how_many = fmt::format("the number of {}", keyword);
  switch (section.lines) {
    case Lines::counted: skip_numbers(scan, scan.count(how_many.c_str()), section.width, wanted); break;
    case Lines::vectors: skip_numbers(scan, scan.count(how_many.c_str()), sizes.dimension, wanted); break;
    case Lines::of_points: skip_numbers(scan, sizes.vertices, section.width, wanted); break;
    case Lines::any:
      while (!scan.at_end() && !starts_a_word(scan.peek())) scan.token(wanted.c_str());
      break;
    case Lines::text: scan.quoted_or_line(wanted.c_str()); break;
    case Lines::texts:
      for (std::uint64_t left = scan.count(how_many.c_str()); left > 0; --left) scan.quoted_or_line(wanted.c_str());
      break;
  }
  return true;
}

}  // namespace dartboard
