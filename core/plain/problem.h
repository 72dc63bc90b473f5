#pragma once
// One mass/spring problem: all the input of a contender, and the mechanics that all of them must agree on.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plain/cell_materials.h"
#include "core/plain/held_axes.h"
#include "core/plain/material.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// A point that is held along some axes.
struct HeldPoint {
  std::uint32_t point;
  HeldAxes axes;
  friend bool operator==(const HeldPoint&, const HeldPoint&) = default;
};

/// Where the points, cells and links of each of several bodies begin in a mesh, and after the last of them their
/// number.
struct BodyRanges {
  std::vector<std::size_t> point{0}, cell{0}, link{0};

  std::size_t count() const { return cell.size() - 1; }
  void end_body_at(std::size_t points, std::size_t cells, std::size_t links) {
    point.push_back(points);
    cell.push_back(cells);
    link.push_back(links);
  }
};

/// A body at rest in `mesh`, with initial velocities, some vertices held still.
///
/// The mechanics, for point i with position x_i, velocity v_i and mass m_i (section 4.1):
///
///     m_i = sum over the cells c around i of density * measure(c) / node_count(c)                      eq. (1)
///     k_ij = stiffness * (number of cells around edge ij),  c_ij = damping * (the same number),  L_ij = rest length
///         if the material has a Young's modulus, the number is replaced by the sum over those cells c of
///         young * measure(c) / L_ij^2 / stiffness: k_ij then does not depend on the stiffness, the mean (material.h)
///     u_ij = (x_j - x_i) / |x_j - x_i|, and no force where the length is zero
///     f_i = sum over the edges ij of ( k_ij (|x_j - x_i| - L_ij) + c_ij (v_j - v_i).u_ij ) u_ij
///     a_i = (f_i - viscosity * m_i * v_i) / m_i + gravity,  and a_i = 0, v_i = 0 for the points in `fixed`
///         and along the axes of those in `held_axes`, which move freely along the others
///
/// The edges are the edges of the cells' faces (`faces_of`). In a body of several materials every cell contributes by
/// its own, except for the viscosity, which is that of `material` for all.
struct Problem {
  Mesh mesh;
  Material material;
  std::vector<Material> materials{};            // of a body of several; empty: all cells are of `material`
  std::vector<MaterialNumber> cell_material{};  // by cell: the number of its material in `materials`
  Surroundings surroundings;
  std::vector<std::uint32_t> fixed;               // point numbers, ascending
  std::vector<Eigen::Vector3d> initial_velocity;  // [m/s] per point; empty for rest
  double h = 1e-3;                                // time step [s]
  std::vector<HeldPoint> held_axes{};             // by ascending point; not for fixed points
  BodyRanges bodies{};                            // of a scene; none where the problem comes from elsewhere

  CellMaterials cell_materials() const { return {material, materials, cell_material}; }
};

/// Positions [m] and velocities [m/s] in the order of the mesh's points.
struct PointState {
  std::vector<Eigen::Vector3d> x, v;
};

}  // namespace dartboard
