#pragma once
// The rest shapes of a body's elements, of whichever kind these are, and the force term over them.

#include <memory>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/elements/membranes.h"
#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"

namespace dartboard {

/// By cell: of a solid of tetrahedra or of any cells, of a surface of triangles or of any faces; nothing with springs.
using ElementShapes = std::variant<std::monostate, std::vector<RestShape>, std::vector<SolidShape>,
                                   std::vector<PlaneInverse>, std::vector<MembraneShape>>;

/// The shapes, if they are of this kind; otherwise none.
template <class Shape>
const std::vector<Shape>& shapes_of(const ElementShapes& shapes) {
  static const std::vector<Shape> none;
  const auto* const of_this_kind = std::get_if<std::vector<Shape>>(&shapes);
  return of_this_kind == nullptr ? none : *of_this_kind;
}
template <class Shape>
bool is_of(const ElementShapes& shapes) {
  return std::holds_alternative<std::vector<Shape>>(shapes);
}
inline bool has_elements(const ElementShapes& shapes) { return shapes.index() != 0; }
/// Do the elements use the corners of cells of any kind (SolidNodes)?
inline bool use_any_cells(const ElementShapes& shapes) {
  return is_of<SolidShape>(shapes) || is_of<MembraneShape>(shapes);
}

/// Append a shape to those of this kind, which are the only ones.
template <class Shape>
void add_shape(ElementShapes& shapes, const Shape& shape) {
  if (!has_elements(shapes)) shapes.emplace<std::vector<Shape>>();
  std::get<std::vector<Shape>>(shapes).push_back(shape);
}

/// Calls use(shapes) if there are any.
template <class Shapes, class Use>
void with_shapes(Shapes& shapes, Use&& use) {
  std::visit(
      [&use]<class Rows>(Rows& rows) {
        if constexpr (!std::is_same_v<const Rows, const std::monostate>) use(rows);
      },
      shapes);
}

/// The corners of elements by cell; only the column that the shapes use has rows.
struct ElementCorners {
  const std::vector<TetrahedronNodes>& tetrahedra;
  const std::vector<SolidNodes>& cells;
  const std::vector<TriangleNodes>& triangles;
};

/// The force term of these elements; null without any.
///
/// pre  the columns live as long as the term, and the shapes stay of their kind; masses [kg] are by cell
std::unique_ptr<ForceTerm> make_elements(const CellMaterials& materials, const ElementShapes& shapes,
                                         const ElementCorners& corners, const std::vector<double>& mass);

}  // namespace dartboard
