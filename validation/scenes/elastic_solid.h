#pragma once
// A solid of elements built by hand: the force term of core, and the elastic points of the references.

#include <memory>
#include <vector>

#include "core/elements/solids.h"
#include "core/elements/tetrahedra.h"
#include "core/plain/cell_materials.h"
#include "core/plain/mesh.h"
#include "reference/elements/elastic_point.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// Tetrahedra, or cells of several kinds, of given materials; at rest in the mesh.
class ElasticSolid {
 public:
  /// Cells of springs have no force in it, and no points of the references.
  /// pre  the mesh is one of tetrahedra or hexahedra; `material_of` has a number for each cell
  ElasticSolid(Mesh rest, std::vector<Material> materials, std::vector<MaterialNumber> material_of);
  ElasticSolid(const ElasticSolid&) = delete;
  ElasticSolid& operator=(const ElasticSolid&) = delete;

  const Mesh& rest() const { return rest_; }
  const Material& material(std::size_t cell) const { return materials_[material_of_[cell]]; }
  const ForceTerm& term() const { return *term_; }
  const std::vector<reference::ElasticPoint>& points() const { return points_; }

  /// Does `other` have the same rest shape and the same materials?
  bool is_like(const ElasticSolid& other) const;

 private:
  Mesh rest_;
  std::vector<Material> materials_;
  std::vector<MaterialNumber> material_of_;
  std::vector<TetrahedronNodes> tetrahedra_;
  std::vector<RestShape> tetrahedron_shapes_;
  std::vector<double> cell_mass_;
  std::vector<SolidNodes> solids_;
  std::vector<SolidShape> solid_shapes_;
  std::unique_ptr<ForceTerm> term_;
  std::vector<reference::ElasticPoint> points_;
};

/// The elements of a body as the witnesses know them; null without elements.
inline const std::vector<reference::ElasticPoint>* elements_of(const SpringColumns& body) {
  return body.solid == nullptr ? nullptr : &body.solid->points();
}

}  // namespace dartboard
