#pragma once
// Linear tetrahedra as a force term: one deformation gradient for each.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/elements/elastic_laws.h"
#include "core/forces/force_term.h"
#include "core/plain/cell_materials.h"
#include "core/plain/material.h"

namespace dartboard {

/// The numbers of the vertices of a tetrahedron, in the order of its rest shape.
using TetrahedronNodes = std::array<std::uint32_t, 4>;

/// What a tetrahedron needs of its rest shape: D^-1 [1/m], D = (X1 - X0, X2 - X0, X3 - X0). Orientation does not
/// matter.
using RestShape = Eigen::Matrix3d;

/// D^-1 of a tetrahedron at rest.
/// returns  something that is not finite where it is flat
RestShape rest_shape_of(const Eigen::Vector3d& x0, const Eigen::Vector3d& x1, const Eigen::Vector3d& x2,
                        const Eigen::Vector3d& x3);

/// Where the tetrahedra of a body are; the term looks there anew in each call, so columns may grow and shrink between.
struct TetrahedronColumns {
  const std::vector<TetrahedronNodes>& nodes;
  const std::vector<RestShape>& shape;
  const std::vector<double>& mass;  // [kg]; over the density, it is the volume at rest
};

/// The forces of tetrahedra. For each, F = (x1 - x0, x2 - x0, x3 - x0) D^-1 and the energy is the
/// volume at rest times that of the material's law at F. No matrix is stored.
///
/// pre      the model is one of elements; the columns live as long as the term
/// source   Zienkiewicz, Taylor: constant strain tetrahedra; the laws: elastic_laws.h
std::unique_ptr<ForceTerm> make_tetrahedra(const CellMaterials& materials, const TetrahedronColumns& columns);

/// The term's virial of one tetrahedron with its corners at x, to the bit.
Virial tetrahedron_virial(const Material& material, double mass, const RestShape& shape,
                          const std::array<Eigen::Vector3d, 4>& x);

}  // namespace dartboard
