#include "core/elements/part_of_elements.h"

#include <type_traits>
#include <vector>

#include "core/forces/rows_of_part.h"

namespace dartboard {
namespace {

std::vector<MaterialNumber> materials_of(const CellMaterials& materials, const std::vector<std::uint32_t>& cells) {
  return materials.numbers() == nullptr ? std::vector<MaterialNumber>{} : rows_of_part(*materials.numbers(), cells);
}

std::span<std::uint32_t> corners_of(TetrahedronNodes& nodes) { return nodes; }
std::span<std::uint32_t> corners_of(TriangleNodes& nodes) { return nodes; }
std::span<std::uint32_t> corners_of(SolidNodes& nodes) { return nodes.corners(); }

/// Copies of the columns of the pieces.
template <class Columns>
struct Own {
  std::remove_cvref_t<decltype(Columns::nodes)> nodes;
  std::remove_cvref_t<decltype(Columns::shape)> shape;
  std::vector<MaterialNumber> material;
  std::vector<double> mass{};  // of tetrahedra

  Own(const Columns& columns, const CellMaterials& materials, const std::vector<std::uint32_t>& pieces,
      const VertexSubset& part)
      : nodes(rows_of_part(columns.nodes, pieces, part, [](auto& row) { return corners_of(row); })),
        shape(rows_of_part(columns.shape, pieces)),
        material(materials_of(materials, pieces)) {}
};

}  // namespace

TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const TetrahedronColumns& columns,
                            const VertexSubset& part) {
  const auto pieces = pieces_of_part(term, part);
  const auto own = std::make_shared<Own<TetrahedronColumns>>(columns, materials, pieces, part);
  own->mass = rows_of_part(columns.mass, pieces);
  return {own, make_tetrahedra(materials.of_cells(own->material), {own->nodes, own->shape, own->mass})};
}

TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const SolidColumns& columns,
                            const VertexSubset& part) {
  const auto own = std::make_shared<Own<SolidColumns>>(columns, materials, pieces_of_part(term, part), part);
  return {own, make_solids(materials.of_cells(own->material), {own->nodes, own->shape})};
}

TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const TriangleColumns& columns,
                            const VertexSubset& part) {
  const auto own = std::make_shared<Own<TriangleColumns>>(columns, materials, pieces_of_part(term, part), part);
  return {own, make_membranes(materials.of_cells(own->material), TriangleColumns{own->nodes, own->shape})};
}

TermOfPart part_of_elements(const ForceTerm& term, const CellMaterials& materials, const MembraneColumns& columns,
                            const VertexSubset& part) {
  const auto own = std::make_shared<Own<MembraneColumns>>(columns, materials, pieces_of_part(term, part), part);
  return {own, make_membranes(materials.of_cells(own->material), MembraneColumns{own->nodes, own->shape})};
}

}  // namespace dartboard
