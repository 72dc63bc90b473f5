#pragma once
// The small meshes of the tests, written out in full, in addition to the generators of core/meshes.

#include <array>
#include <cstdint>
#include <random>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/mesh.h"

namespace dartboard::reference {

/// A regular tetrahedron with edges of 2 sqrt(2) around the origin, right-handed, volume 8/3.
inline Mesh regular_tetrahedron() {
  Mesh mesh;
  mesh.points = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  return mesh;
}

/// Two tetrahedra of volumes 1/6 and 1/3 (m^3) on either side of the triangle 0 1 2; points 3 and 4 are the tips.
inline Mesh unequal_tetrahedra() {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}};
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 2, 1, 4});
  return mesh;
}

/// nx x ny x nz cubes of edge `spacing` [m], each cut into six tetrahedra around its main diagonal. Every coordinate
/// of every point is moved by at most `jitter` spacings; 0.1 keeps all tetrahedra right-handed. The numbers come from
/// the bits of a Mersenne twister, so that they are the same on every platform.
inline Mesh kuhn_grid(int nx, int ny, int nz, double spacing, double jitter = 0, unsigned seed = 0) {
  std::mt19937 bits(seed);
  const auto shift = [&] { return jitter * (static_cast<double>(bits()) / 2147483648.0 - 1.0); };

  Mesh mesh;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) {
        const double dx = shift(), dy = shift(), dz = shift();  // named: the order of arguments is unspecified
        mesh.points.emplace_back(spacing * (x + dx), spacing * (y + dy), spacing * (z + dz));
      }

  // a path of three steps from corner to opposite corner is a tetrahedron; odd orders of the axes are left-handed
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int o = 0; o < 6; ++o) {
          std::array<int, 3> at{x, y, z};
          std::array<std::uint32_t, 4> path{};
          for (std::size_t k = 0; k < 4; ++k) {
            path[k] = static_cast<std::uint32_t>((at[2] * (ny + 1) + at[1]) * (nx + 1) + at[0]);
            if (k < 3) ++at[static_cast<std::size_t>(orders[o][k])];
          }
          if (o >= 3) std::swap(path[2], path[3]);
          mesh.add_cell(CellKind::tetrahedron, path);
        }
  return mesh;
}

}  // namespace dartboard::reference

// ---- meshes of the core's tests

namespace dartboard {

using reference::kuhn_grid;
using reference::regular_tetrahedron;
using reference::unequal_tetrahedra;

/// One of each: a unit cube, a pyramid on its top, a prism at its side, a tetrahedron at an end of the prism.
inline Mesh mixed_cells() {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},     {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}, {2, 0, 0}, {2, 1, 0}, {1.25, -1, 0.25}};
  mesh.add_cell(CellKind::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_cell(CellKind::pyramid, std::array<std::uint32_t, 5>{4, 5, 6, 7, 8});
  mesh.add_cell(CellKind::prism, std::array<std::uint32_t, 6>{1, 5, 9, 2, 6, 10});
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{1, 9, 5, 11});
  return mesh;
}

/// A sheet of nx x ny quadrilaterals, closed in y and, if `closed_in_x`, in x; `flip` turns the y axis over at the
/// seam in x. The points lie on a lattice with a bump, so that no side has length zero; it is not an immersion.
inline Mesh sheet(int nx, int ny, bool closed_in_x, bool closed_in_y, bool flip) {
  Mesh mesh;
  const int px = closed_in_x ? nx : nx + 1, py = closed_in_y ? ny : ny + 1;
  for (int x = 0; x < px; ++x)
    for (int y = 0; y < py; ++y) mesh.points.emplace_back(x, y, 0.125 * ((x * x + 2 * y * y) % 5));
  const auto at = [&](int x, int y) {
    if (closed_in_x && x == px) {
      x = 0;
      if (flip) y = closed_in_y ? (py - y) % py : py - 1 - y;
    }
    return static_cast<std::uint32_t>(x * py + y % py);
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      mesh.add_cell(CellKind::quadrilateral, std::array{at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
  return mesh;
}
inline Mesh quadrilateral_grid(int nx, int ny) { return sheet(nx, ny, false, false, false); }
inline Mesh moebius_lattice() { return sheet(5, 1, true, false, true); }
inline Mesh torus_lattice() { return sheet(4, 3, true, true, false); }
inline Mesh klein_lattice() { return sheet(4, 3, true, true, true); }

/// Fig. 3b: eight tetrahedra in a ring around point 0, joined by faces, that leave out a cone above and one below it.
/// The neighbourhood of point 0 is a cone over an annulus, a "pinched ball".
inline Mesh pinched_ring() {
  Mesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 1},  {0, 1, 1},   {-1, 0, 1}, {0, -1, 1},
                 {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}, {0, -1, -1}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t above = 1 + k, next = 1 + (k + 1) % 4;
    mesh.add_cell(CellKind::tetrahedron, std::array{0u, above, above + 4, next});
    mesh.add_cell(CellKind::tetrahedron, std::array{0u, next, above + 4, next + 4});
  }
  return mesh;
}

}  // namespace dartboard
