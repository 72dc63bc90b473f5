#pragma once
// Hexahedra, prisms, pyramids and tetrahedra in one force term, integrated at Gauss points.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/forces/force_term.h"
#include "core/plain/cell_materials.h"
#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// The numbers of the vertices of a solid cell, as many as its kind has, in the order of its rest shape.
struct SolidNodes {
  std::uint32_t count = 0;
  std::array<std::uint32_t, 8> at{};
  std::span<std::uint32_t> corners() { return {at.data(), count}; }
  friend bool operator==(const SolidNodes&, const SolidNodes&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(count);
    for (std::uint32_t& node : at) archive(node);
  }
};

/// The rest shape of a solid cell at each of its Gauss points: the inverse of the Jacobian [1/m], from coordinates of
/// the kind of cell to places, and the volume [m^3] that the point stands for.
struct SolidShape {
  CellKind kind = CellKind::tetrahedron;
  std::array<Eigen::Matrix3d, 8> inverse;
  std::array<double, 8> volume{};
  template <class Archive>
  void state(Archive& archive) {
    archive(kind);
    for (std::size_t q = 0; q < 8; ++q) {
      for (double& entry : inverse[q].reshaped()) archive(entry);
      archive(volume[q]);
    }
  }
};

/// The rest shape of a cell whose corners are at `x`, in the order of its kind.
/// returns  volumes that are not all positive if the cell is flat or turned inside out somewhere
SolidShape solid_shape_of(CellKind kind, std::span<const Eigen::Vector3d> x);
/// The number of Gauss points of a kind: 8 for a hexahedron or a pyramid, 6 for a prism, 1 for a tetrahedron.
std::size_t gauss_points(CellKind kind);

/// The columns of the cells of a body; the term reads them anew in each call.
struct SolidColumns {
  const std::vector<SolidNodes>& nodes;
  const std::vector<SolidShape>& shape;
};

/// The forces of isoparametric cells: trilinear hexahedra, prisms linear in the triangle and along the
/// axis, pyramids as hexahedra with one side contracted to a point, linear tetrahedra. They are compatible: neighbours
/// have the same displacements on their common face. Full integration: a uniform strain is exact in cells of any shape.
///
/// source  Zienkiewicz, Taylor: The Finite Element Method, on isoparametric elements
std::unique_ptr<ForceTerm> make_solids(const CellMaterials& materials, const SolidColumns& columns);

/// The term's virial of one cell with its corners at x, with the same bits.
Virial solid_virial(const Material& material, const SolidShape& shape, std::span<const Eigen::Vector3d> x);

}  // namespace dartboard
