#pragma once
// Linear tetrahedra as a force term, with one deformation gradient for each tetrahedron.

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

/// The rest shape of a tetrahedron: D^-1 [1/m], D = (X1 - X0, X2 - X0, X3 - X0). Its orientation does not
/// matter.
using RestShape = Eigen::Matrix3d;

/// D^-1 of a tetrahedron at rest.
/// returns  numbers that are not finite if it is flat
RestShape rest_shape_of(const Eigen::Vector3d& x0, const Eigen::Vector3d& x1, const Eigen::Vector3d& x2,
                        const Eigen::Vector3d& x3);

/// The columns of the tetrahedra of a body; the term reads them anew in each call, so that their sizes may change.
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

/// The term's virial of one tetrahedron with its corners at x, with the same bits.
Virial tetrahedron_virial(const Material& material, double mass, const RestShape& shape,
                          const std::array<Eigen::Vector3d, 4>& x);

}  // namespace dartboard
