#include "core/meshes/formats/medit_sections.h"

#include <algorithm>

#include "core/meshes/text/letter_case.h"

namespace dartboard {
namespace {

constexpr MeditSection sections[] = {
    {"Triangles", 6, CellKind::triangle, 3},
    {"Quadrilaterals", 7, CellKind::quadrilateral, 4},
    {"Tetrahedra", 8, CellKind::tetrahedron, 4},
    {"Pyramids", 49, CellKind::pyramid, 5},
    {"Prisms", 9, CellKind::prism, 6},
    {"Pentahedra", 9, CellKind::prism, 6},
    {"Hexahedra", 10, CellKind::hexahedron, 8},
    {"Hexaedra", 10, CellKind::hexahedron, 8},
    {"TrianglesP2", 24, CellKind::triangle, 6, "6-node triangle"},
    {"QuadrilateralsQ2", 27, CellKind::quadrilateral, 9, "9-node quadrilateral"},
    {"TetrahedraP2", 30, CellKind::tetrahedron, 10, "10-node tetrahedron"},
    {"PyramidsP2", 87, CellKind::pyramid, 14, "14-node pyramid"},
    {"PrismsP2", 86, CellKind::prism, 18, "18-node prism"},
    {"HexahedraQ2", 33, CellKind::hexahedron, 27, "27-node hexahedron"},
};

const MeditSection* found(const MeditSection* at) { return at == std::end(sections) ? nullptr : at; }

}  // namespace

const MeditSection* medit_section(std::string_view keyword) {
  return found(std::ranges::find_if(sections, [&](const MeditSection& s) { return same_letters(s.keyword, keyword); }));
}

const MeditSection* medit_section(std::int64_t code) {
  return found(std::ranges::find(sections, code, &MeditSection::code));
}

}  // namespace dartboard
