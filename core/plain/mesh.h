#pragma once
// The plain mesh: points, and cells as lists of point numbers. It is all of a body that core and reference share.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dartboard {

/// Kinds of cell, with the node order of Gmsh (also VTK's, except for the prism, which VTK documents mirrored).
enum class CellKind : std::uint8_t { triangle, quadrilateral, tetrahedron, pyramid, prism, hexahedron };

int node_count(CellKind kind);
int dimension(CellKind kind);
std::string_view name(CellKind kind);

/// The faces of one cell of `kind`, each as the cycle of its local nodes; for a 2D kind, the one face it is.
/// In a right-handed 3D cell every cycle runs counter-clockwise seen from outside.
std::span<const std::vector<int>> faces_of(CellKind kind);

/// Points [m] and cells; cells are stored back to back in `nodes`. Points of chains belong to no cell but to links.
struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<CellKind> kinds;
  std::vector<std::uint32_t> first{0};  // first[c] .. first[c+1]: where the nodes of cell c lie
  std::vector<std::uint32_t> nodes;
  std::vector<std::array<std::uint32_t, 2>> links{};  // of chains: two points each

  std::size_t cell_count() const { return kinds.size(); }
  std::span<const std::uint32_t> cell(std::size_t c) const {
    return std::span(nodes).subspan(first[c], first[c + 1] - first[c]);
  }
  void add_cell(CellKind kind, std::span<const std::uint32_t> cell_nodes);

  /// 2 when all cells are polygons, 3 when all are volumes; 0 for no cell.
  /// throws  InputError when both occur
  int dimension() const;
  /// The highest dimension of a cell, where polygons and volumes may both occur; 0 for no cell.
  int highest_dimension() const;
};

/// Has it more than one of volumes, polygons and links?
bool is_mixed(const Mesh& mesh);

/// Add the points, cells and links of another mesh after the present ones.
/// throws  InputError if there are not enough numbers for them
void append(Mesh& mesh, const Mesh& other);

/// Signed measure of a cell: the volume [m^3] of a 3D cell, positive when right-handed; the area [m^2] of a polygon.
/// Exact for tetrahedra; other volumes are split into tetrahedra from the centroid of the cell and of its faces.
double signed_measure(const Mesh& mesh, std::size_t c);

}  // namespace dartboard
