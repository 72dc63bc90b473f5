#pragma once
// A surface of membranes as bare columns, from a mesh of triangles and quadrilaterals: no map.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "core/elements/membranes.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/mesh.h"
#include "core/plain/random.h"

namespace dartboard {

inline constexpr std::array membrane_models{Model::stvk, Model::corotational};

inline Material sheet_material(double young = 2e3, double poisson = 0.3, Model model = Model::stvk) {
  return {.density = 0.5,
          .stiffness = 0.0,
          .damping = 0.0,
          .viscosity = 0.5,
          .young = young,
          .poisson = poisson,
          .model = model};
}

struct MembraneBody {
  Mesh mesh;
  Material material;
  std::vector<Eigen::Vector3d> x;
  std::vector<SolidNodes> nodes;
  std::vector<MembraneShape> shape;
  std::vector<TriangleNodes> triangles;  // for a mesh of triangles alone, in place of both
  std::vector<PlaneInverse> triangle_shape;
  std::unique_ptr<ForceTerm> term;

  explicit MembraneBody(const Mesh& of, const Material& made_of = sheet_material())
      : mesh(of), material(made_of), x(of.points) {
    bool all_triangles = true;
    for (const CellKind kind : mesh.kinds) all_triangles = all_triangles && kind == CellKind::triangle;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      SolidNodes n;
      std::vector<Eigen::Vector3d> corners;
      for (const std::uint32_t p : mesh.cell(c)) {
        n.at[n.count++] = p;
        corners.push_back(mesh.points[p]);
      }
      if (all_triangles) {
        triangles.push_back({n.at[0], n.at[1], n.at[2]});
        triangle_shape.push_back(triangle_shape_of(corners[0], corners[1], corners[2]));
      } else {
        nodes.push_back(n);
        shape.push_back(membrane_shape_of(corners));
      }
    }
    term = all_triangles ? make_membranes(material, TriangleColumns{triangles, triangle_shape})
                         : make_membranes(material, MembraneColumns{nodes, shape});
  }
  MembraneBody(const MembraneBody&) = delete;  // the term keeps pointers to the columns

  double energy() const { return term->energy(x); }
  void shake(double size, std::uint64_t seed) {
    SplitMix64 random(seed);
    for (Eigen::Vector3d& p : x)
      for (double& c : p) c += size * random.next_signed();
  }
};

/// Squares of spacing 0.1 m in the plane z = 0, every other one halved, their inner points moved within the plane by up
/// to 0.03 m.
inline Mesh mixed_sheet(int nx, int ny, std::uint64_t seed = 3) {
  const Mesh squares = quad_sheet(nx, ny, 0.1);
  Mesh mesh;
  mesh.points = squares.points;
  for (std::size_t c = 0; c < squares.cell_count(); ++c) {
    const auto q = squares.cell(c);
    if (c % 2 == 0) {
      mesh.add_cell(CellKind::quadrilateral, q);
    } else {
      mesh.add_cell(CellKind::triangle, std::array{q[0], q[1], q[2]});
      mesh.add_cell(CellKind::triangle, std::array{q[0], q[2], q[3]});
    }
  }
  SplitMix64 random(seed);
  for (Eigen::Vector3d& p : mesh.points)
    if (p[0] > 0.05 && p[1] > 0.05 && p[0] < 0.1 * nx - 0.05 && p[1] < 0.1 * ny - 0.05)
      for (int k = 0; k < 2; ++k) p[k] += 0.03 * random.next_signed();
  return mesh;
}
/// The same with triangles only.
inline Mesh crooked_triangles(int nx, int ny, std::uint64_t seed = 4) {
  Mesh mesh = triangle_sheet(nx, ny, 0.1);
  mesh.points = mixed_sheet(nx, ny, seed).points;
  return mesh;
}
/// Bent to a saddle at rest, so that its quadrilaterals are not flat.
inline Mesh saddle(Mesh mesh) {
  for (Eigen::Vector3d& p : mesh.points) p[2] += 1.5 * p[0] * p[1] - 0.5 * p[0] * p[0];
  return mesh;
}

}  // namespace dartboard
