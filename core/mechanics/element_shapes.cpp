#include "core/mechanics/element_shapes.h"

#include "core/base/overloads.h"

namespace dartboard {

std::unique_ptr<ForceTerm> make_elements(const CellMaterials& materials, const ElementShapes& shapes,
                                         const ElementCorners& corners, const std::vector<double>& mass) {
  using Term = std::unique_ptr<ForceTerm>;
  return std::visit(Overloads{[](const std::monostate&) { return Term(); },
                              [&](const std::vector<RestShape>& shape) {
                                return make_tetrahedra(materials, {corners.tetrahedra, shape, mass});
                              },
                              [&](const std::vector<SolidShape>& shape) {
                                return make_solids(materials, {corners.cells, shape});
                              },
                              [&](const std::vector<PlaneInverse>& shape) {
                                return make_membranes(materials, TriangleColumns{corners.triangles, shape});
                              },
                              [&](const std::vector<MembraneShape>& shape) {
                                return make_membranes(materials, MembraneColumns{corners.cells, shape});
                              }},
                    shapes);
}

}  // namespace dartboard
