#pragma once
// Membranes as a force term: triangles of constant strain, and bilinear quadrilaterals integrated at Gauss points.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/elements/solids.h"
#include "core/forces/force_term.h"
#include "core/plain/cell_materials.h"
#include "core/plain/material.h"

namespace dartboard {

/// The numbers of the vertices of a triangle, in the order of its rest shape.
using TriangleNodes = std::array<std::uint32_t, 3>;

/// The inverse (a, b; 0, c) [1/m] of a Jacobian (p, q; 0, r), from coordinates of the kind of cell to places in its
/// plane at rest, whose first axis is along the first coordinate. Surfaces are isotropic, so that any axes would do;
/// with these axes three numbers are enough.
using PlaneInverse = std::array<double, 3>;

/// The rest shape of a surface cell at each of its Gauss points: 4 for a quadrilateral, 1 for a triangle.
using MembraneShape = std::array<PlaneInverse, 4>;

/// The rest shape of a triangle whose corners are at x0, x1, x2.
/// returns  numbers that are not finite if it is flat
PlaneInverse triangle_shape_of(const Eigen::Vector3d& x0, const Eigen::Vector3d& x1, const Eigen::Vector3d& x2);

/// The rest shape of a triangle or a quadrilateral, which need not be flat, with its corners in order around it.
/// returns  a last number that is not above 0, or not finite, where it degenerates to a line or is turned over against
///          its middle
MembraneShape membrane_shape_of(std::span<const Eigen::Vector3d> x);
/// The number of Gauss points of a cell with so many corners.
constexpr std::size_t membrane_points(std::size_t corners) { return corners == 3 ? 1 : 4; }

/// The columns of the cells of a surface of triangles; the term reads them anew in each call.
struct TriangleColumns {
  const std::vector<TriangleNodes>& nodes;
  const std::vector<PlaneInverse>& shape;

  std::size_t size() const { return nodes.size(); }
  std::span<const std::uint32_t, 3> corners(std::size_t c) const { return nodes[c]; }
  std::span<const PlaneInverse, 1> points(std::size_t c) const {
    return std::span<const PlaneInverse, 1>(&shape[c], 1);
  }
};
/// The columns of a surface of triangles and quadrilaterals.
struct MembraneColumns {
  const std::vector<SolidNodes>& nodes;
  const std::vector<MembraneShape>& shape;

  std::size_t size() const { return nodes.size(); }
  std::span<const std::uint32_t> corners(std::size_t c) const { return {nodes[c].at.data(), nodes[c].count}; }
  std::span<const PlaneInverse> points(std::size_t c) const {
    return {shape[c].data(), membrane_points(nodes[c].count)};
  }
};

/// The forces of membranes in plane stress. At each Gauss point F is 3 x 2, the derivative of places by places in the
/// plane at rest, and the energy is the area that the point stands for times that of the material's law at F.
/// Neighbours have the same displacements on the edge that they share; a uniform strain is exact in flat cells of any
/// shape. There is no stiffness against bending, nor at rest across the surface. Cells of springs have no force
/// here.
///
/// pre      the columns live as long as the term
/// throws   InputError for a model that surfaces do not have (membrane_law.h)
/// source   Zienkiewicz, Taylor: The Finite Element Method, on plane stress
std::unique_ptr<ForceTerm> make_membranes(const CellMaterials& materials, const TriangleColumns& columns);
std::unique_ptr<ForceTerm> make_membranes(const CellMaterials& materials, const MembraneColumns& columns);

/// The term's virial of one cell with its corners at x, with the same bits.
Virial membrane_virial(const Material& material, std::span<const PlaneInverse> points,
                       std::span<const Eigen::Vector3d> x);

}  // namespace dartboard
