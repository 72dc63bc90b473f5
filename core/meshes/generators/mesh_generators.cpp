#include "core/meshes/generators/mesh_generators.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/meshes/generators/mesh_generator_parts.h"
#include "core/plain/error.h"

namespace dartboard {

using namespace detail;

namespace {

/// The nodes of a cube: bit 0 of the index for x, bit 1 for y, bit 2 for z.
using Corners = std::array<std::uint32_t, 8>;

/// A box of cubes and the numbers of its nodes: x fastest, then y, then z.
struct Box {
  std::uint32_t nx, ny, nz;

  std::uint32_t node(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (z * (ny + 1) + y) * (nx + 1) + x;
  }
  template <class F>
  void for_each_cube(F&& f) const {
    for (std::uint32_t z = 0; z < nz; ++z)
      for (std::uint32_t y = 0; y < ny; ++y)
        for (std::uint32_t x = 0; x < nx; ++x) {
          Corners corner{};
          for (std::uint32_t k = 0; k < 8; ++k) corner[k] = node(x + (k & 1u), y + (k >> 1 & 1u), z + (k >> 2));
          f(x, y, z, corner);
        }
  }
};

/// Check the numbers of a box and add its points, moved by `origin`.
Box add_box(Mesh& mesh, const char* generator, std::array<int, 3> n, double spacing, const Eigen::Vector3d& origin,
            CellKind kind, double cells_per_cube) {
  for (const int cubes : n) require_at_least(generator, "cubes along an axis", cubes, 1);
  require_spacing(generator, spacing);
  require_room(generator, kind, cells_per_cube * n[0] * n[1] * n[2]);
  const Box box{static_cast<std::uint32_t>(n[0]), static_cast<std::uint32_t>(n[1]), static_cast<std::uint32_t>(n[2])};
  for (std::uint32_t z = 0; z <= box.nz; ++z)
    for (std::uint32_t y = 0; y <= box.ny; ++y)
      for (std::uint32_t x = 0; x <= box.nx; ++x)
        mesh.points.emplace_back(origin.x() + spacing * x, origin.y() + spacing * y, origin.z() + spacing * z);
  return box;
}

/// The cube cut around the diagonal from corner 0 to corner 7: a tetrahedron for each order in which three steps along
/// the three axes lead from one to the other. If the corners of a cube are `mirrored`, all six turn the other way.
void add_kuhn_cube(Mesh& mesh, const Corners& corner, bool mirrored = false) {
  for (const std::uint32_t a : {1u, 2u, 4u})
    for (const std::uint32_t b : {1u, 2u, 4u}) {
      if (a == b) continue;
      // x, y, z and its rotations turn to the right; the other three orders are mirrored
      const bool right_handed = b == (a == 4 ? 1 : 2 * a);
      const std::uint32_t p = corner[a], q = corner[a | b];
      if (right_handed != mirrored)
        add(mesh, CellKind::tetrahedron, corner[0], p, q, corner[7]);
      else
        add(mesh, CellKind::tetrahedron, corner[0], q, p, corner[7]);
    }
}

void add_hexahedron(Mesh& mesh, const Corners& c) {
  add(mesh, CellKind::hexahedron, c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]);
}

/// Move the points for which `movable` holds; see kuhn_box.
void jitter_points(Mesh& mesh, const std::vector<bool>& movable, double reach, std::uint64_t seed) {
  std::vector<std::vector<std::uint32_t>> around(mesh.points.size());
  std::vector<double> least(mesh.cell_count());
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    least[c] = 0.1 * signed_measure(mesh, c);
    for (const std::uint32_t p : mesh.cell(c)) around[p].push_back(static_cast<std::uint32_t>(c));
  }
  SplitMix64 random(seed);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (!movable[p]) continue;
    const Eigen::Vector3d from = mesh.points[p];
    Eigen::Vector3d move = reach * random.next_in_ball();
    const auto fits = [&] {
      for (const std::uint32_t c : around[p])
        if (!(signed_measure(mesh, c) >= least[c])) return false;
      return true;
    };
    // the loop ends: a move too short to change a coordinate keeps the old volumes, which fit
    for (mesh.points[p] = from + move; mesh.points[p] != from && !fits(); mesh.points[p] = from + move) move /= 2.0;
  }
}

/// `add_cube(x, y, z, corners)` adds six tetrahedra.
template <class AddCube>
Mesh tetrahedron_box(const char* generator, std::array<int, 3> n, double spacing, double jitter, std::uint64_t seed,
                     AddCube&& add_cube) {
  Mesh mesh;
  const Box box = add_box(mesh, generator, n, spacing, Eigen::Vector3d::Zero(), CellKind::tetrahedron, 6);
  if (!(jitter >= 0.0 && std::isfinite(jitter * spacing)))
    throw InputError(fmt::format("{}: jitter = {}, expected a finite number >= 0", generator, jitter));
  box.for_each_cube([&](auto x, auto y, auto z, const Corners& corner) { add_cube(mesh, x, y, z, corner); });
  if (jitter > 0.0) {
    std::vector<bool> inside(mesh.points.size());
    for (std::uint32_t z = 1; z < box.nz; ++z)
      for (std::uint32_t y = 1; y < box.ny; ++y)
        for (std::uint32_t x = 1; x < box.nx; ++x) inside[box.node(x, y, z)] = true;
    jitter_points(mesh, inside, jitter * spacing, seed);
  }
  return mesh;
}

}  // namespace

Mesh kuhn_box(int nx, int ny, int nz, double spacing, double jitter, std::uint64_t seed) {
  return tetrahedron_box("kuhn_box", {nx, ny, nz}, spacing, jitter, seed,
                         [](Mesh& mesh, auto, auto, auto, const Corners& corner) { add_kuhn_cube(mesh, corner); });
}

Mesh mirrored_box(int nx, int ny, int nz, double spacing, double jitter, std::uint64_t seed) {
  return tetrahedron_box("mirrored_box", {nx, ny, nz}, spacing, jitter, seed,
                         [](Mesh& mesh, std::uint32_t x, std::uint32_t y, std::uint32_t z, const Corners& corner) {
                           const std::uint32_t flips = (x & 1u) | (y & 1u) << 1 | (z & 1u) << 2;
                           Corners from{};
                           for (std::uint32_t k = 0; k < 8; ++k) from[k] = corner[k ^ flips];
                           add_kuhn_cube(mesh, from, (x + y + z) % 2 == 1);
                         });
}

Mesh hexahedron_box(int nx, int ny, int nz, double spacing) {
  Mesh mesh;
  const Box box =
      add_box(mesh, "hexahedron_box", {nx, ny, nz}, spacing, Eigen::Vector3d::Zero(), CellKind::hexahedron, 1);
  box.for_each_cube([&](auto, auto, auto, const Corners& corner) { add_hexahedron(mesh, corner); });
  return mesh;
}

Mesh mixed_box(int nx, int ny, int nz, double spacing) {
  Mesh mesh;
  // no cube has more darts than six pyramids, or four and four tetrahedra: as many as seven
  const Box box = add_box(mesh, "mixed_box", {nx, ny, nz}, spacing, Eigen::Vector3d::Zero(), CellKind::pyramid, 7);
  box.for_each_cube([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, const Corners& corner) {
    const bool cut = (x + y) % 2 == 1;
    const Corners c{corner[0], corner[1], corner[3], corner[2], corner[4], corner[5], corner[7], corner[6]};
    if (z % 2 == 0 && !cut) {
      add_hexahedron(mesh, corner);
    } else if (z % 2 == 0) {
      add(mesh, CellKind::prism, c[0], c[1], c[2], c[4], c[5], c[6]);
      add(mesh, CellKind::prism, c[0], c[2], c[3], c[4], c[6], c[7]);
    } else {
      const auto centre = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.emplace_back(spacing * (x + 0.5), spacing * (y + 0.5), spacing * (z + 0.5));
      const auto faces = faces_of(CellKind::hexahedron);  // the first two are below and above
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto at = [&](std::size_t k) { return c[static_cast<std::size_t>(faces[f][k])]; };
        // seen from the centre the cycle of a face runs the other way round
        if (cut && f < 2) {
          add(mesh, CellKind::tetrahedron, at(0), at(2), at(1), centre);
          add(mesh, CellKind::tetrahedron, at(0), at(3), at(2), centre);
        } else {
          add(mesh, CellKind::pyramid, at(3), at(2), at(1), at(0), centre);
        }
      }
    }
  });
  return mesh;
}

Mesh empty_mesh() { return {}; }

Mesh one_tetrahedron() {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add(mesh, CellKind::tetrahedron, 0, 1, 2, 3);
  return mesh;
}

Mesh two_tetrahedra() {
  Mesh mesh = one_tetrahedron();
  mesh.points.emplace_back(1, 1, 1);
  add(mesh, CellKind::tetrahedron, 1, 2, 3, 4);
  return mesh;
}

Mesh touching_at_edge() {
  Mesh mesh = one_tetrahedron();
  mesh.points.emplace_back(-1, 0, 0);
  mesh.points.emplace_back(0, -1, 0);
  add(mesh, CellKind::tetrahedron, 0, 4, 5, 3);
  return mesh;
}

Mesh touching_at_vertex() {
  Mesh mesh = one_tetrahedron();
  mesh.points.emplace_back(-1, 0, 0);
  mesh.points.emplace_back(0, 0, -1);
  mesh.points.emplace_back(0, -1, 0);
  add(mesh, CellKind::tetrahedron, 0, 4, 5, 6);
  return mesh;
}

Mesh solid_torus(int n) {
  require_at_least("solid_torus", "n", n, 3);
  require_room("solid_torus", CellKind::tetrahedron, 6.0 * n);
  Mesh mesh;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d direction = on_circle(i, n);
    for (const double height : {0.0, 1.0})
      for (const double radius : {1.0, 2.0})
        mesh.points.emplace_back(radius * direction.x(), radius * direction.y(), height);
  }
  for (int i = 0; i < n; ++i) {
    // outwards is a cube's first axis, along the ring its second
    const auto here = static_cast<std::uint32_t>(4 * i), ahead = static_cast<std::uint32_t>(4 * ((i + 1) % n));
    add_kuhn_cube(mesh, {here, here + 1, ahead, ahead + 1, here + 2, here + 3, ahead + 2, ahead + 3});
  }
  return mesh;
}

Mesh pinched_body(int sides) {
  require_at_least("pinched_body", "sides", sides, 3);
  require_room("pinched_body", CellKind::tetrahedron, 2.0 * sides);
  const auto n = static_cast<std::uint32_t>(sides);
  Mesh mesh;
  mesh.points.emplace_back(0, 0, 0);
  // points 1 .. 2n zigzag around: odd ones below, even ones above, half a side further
  for (int i = 0; i < 2 * sides; ++i) {
    const Eigen::Vector2d direction = on_circle(i, 2 * sides);
    mesh.points.emplace_back(direction.x(), direction.y(), i % 2 == 0 ? -0.5 : 0.5);
  }
  const auto at = [&](std::uint32_t i) { return 1 + i % (2 * n); };
  for (std::uint32_t i = 0; i < 2 * n; i += 2) {
    add(mesh, CellKind::tetrahedron, 0, at(i), at(i + 2), at(i + 1));      // stands on an edge below
    add(mesh, CellKind::tetrahedron, 0, at(i + 1), at(i + 2), at(i + 3));  // hangs from an edge above
  }
  return mesh;
}

Mesh several_components(int k) {
  require_at_least("several_components", "k", k, 0);
  require_room("several_components", CellKind::tetrahedron, 3.0 * k * (k + 1.0));
  Mesh mesh;
  for (int i = 0; i < k; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const Box box =
        add_box(mesh, "several_components", {1, 1, i + 1}, 1.0, {2.0 * i, 0.0, 0.0}, CellKind::tetrahedron, 6);
    box.for_each_cube([&](auto, auto, auto, Corners corner) {
      for (std::uint32_t& node : corner) node += first;
      add_kuhn_cube(mesh, corner);
    });
  }
  return mesh;
}

std::span<const NamedMesh> test_meshes() {
  static const std::vector<NamedMesh> all{
      {"empty", "nothing at all", [] { return empty_mesh(); }},
      {"one_tetrahedron", "one tetrahedron", [] { return one_tetrahedron(); }},
      {"two_tetrahedra", "two tetrahedra sharing a face", [] { return two_tetrahedra(); }},
      {"touching_at_edge", "two tetrahedra sharing only an edge", [] { return touching_at_edge(); }},
      {"touching_at_vertex", "two tetrahedra sharing only a point", [] { return touching_at_vertex(); }},
      {"kuhn_box", "3 x 4 x 5 cubes of six tetrahedra", [] { return kuhn_box(3, 4, 5, 0.1); }},
      {"kuhn_box_jittered", "6 x 6 x 6 cubes of six tetrahedra, inner points moved",
       [] { return kuhn_box(6, 6, 6, 0.1, 0.3, 1); }},
      {"hexahedron_box", "3 x 4 x 5 hexahedra", [] { return hexahedron_box(3, 4, 5, 0.1); }},
      {"mixed_box", "hexahedra, prisms, pyramids and tetrahedra, face to face", [] { return mixed_box(3, 3, 4, 0.1); }},
      {"solid_torus", "a ring of twelve blocks of tetrahedra", [] { return solid_torus(12); }},
      {"pinched_body", "Fig. 3b: a vertex whose neighbourhood is no ball", [] { return pinched_body(); }},
      {"pinched_drum", "a pinched body of sixteen tetrahedra", [] { return pinched_body(8); }},
      {"tetrahedron_ball", "a ball of four layers of tetrahedra", [] { return tetrahedron_ball(4, 0.5); }},
      {"several_components", "five boxes of different length", [] { return several_components(5); }},
      {"triangle_sheet", "a flat sheet of 8 x 5 x 2 triangles", [] { return triangle_sheet(8, 5, 0.1); }},
      {"quad_sheet", "a flat sheet of 8 x 5 squares", [] { return quad_sheet(8, 5, 0.1); }},
      {"torus_surface", "a closed surface with a hole", [] { return torus_surface(12, 8); }},
      {"moebius_strip", "a surface with one side and one boundary", [] { return moebius_strip(11); }},
      {"klein_bottle", "a closed surface with one side", [] { return klein_bottle(12, 8); }},
      {"octahedron", "the closed surface of eight triangles", [] { return octasphere(0); }},
      {"octasphere", "a sphere of 512 triangles", [] { return octasphere(3); }},
  };
  return all;
}

}  // namespace dartboard
