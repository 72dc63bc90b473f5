// The surfaces of mesh_generators.h.

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/meshes/generators/mesh_generator_parts.h"
#include "core/meshes/generators/mesh_generators.h"

namespace dartboard {

using namespace detail;

namespace {

/// Check the numbers of a sheet, add its points, and call f(a, b, c, d) with the corners of each square.
template <class F>
void add_sheet(Mesh& mesh, const char* generator, int nx, int ny, double spacing, F&& f) {
  require_at_least(generator, "nx", nx, 1);
  require_at_least(generator, "ny", ny, 1);
  require_spacing(generator, spacing);
  require_room(generator, CellKind::triangle, 2.0 * nx * ny);
  for (int y = 0; y <= ny; ++y)
    for (int x = 0; x <= nx; ++x) mesh.points.emplace_back(spacing * x, spacing * y, 0.0);
  const auto at = [nx](int x, int y) {
    return static_cast<std::uint32_t>(y) * (static_cast<std::uint32_t>(nx) + 1) + static_cast<std::uint32_t>(x);
  };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) f(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
}

/// nu x nv quadrilaterals, closed in both directions; the node that follows (nu - 1, j) is (0, seam(j)).
template <class Seam>
void add_closed_quads(Mesh& mesh, int nu, int nv, Seam seam) {
  const auto at = [&](int i, int j) {
    j %= nv;
    if (i == nu) return static_cast<std::uint32_t>(seam(j));
    return static_cast<std::uint32_t>(i) * static_cast<std::uint32_t>(nv) + static_cast<std::uint32_t>(j);
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      add(mesh, CellKind::quadrilateral, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

void require_closed(const char* generator, int nu, int nv) {
  require_at_least(generator, "nu", nu, 3);
  require_at_least(generator, "nv", nv, 3);
  require_room(generator, CellKind::quadrilateral, 1.0 * nu * nv);
}

}  // namespace

Mesh triangle_sheet(int nx, int ny, double spacing) {
  Mesh mesh;
  add_sheet(mesh, "triangle_sheet", nx, ny, spacing, [&](auto a, auto b, auto c, auto d) {
    add(mesh, CellKind::triangle, a, b, c);
    add(mesh, CellKind::triangle, a, c, d);
  });
  return mesh;
}

Mesh quad_sheet(int nx, int ny, double spacing) {
  Mesh mesh;
  add_sheet(mesh, "quad_sheet", nx, ny, spacing,
            [&](auto a, auto b, auto c, auto d) { add(mesh, CellKind::quadrilateral, a, b, c, d); });
  return mesh;
}

Mesh torus_surface(int nu, int nv) {
  require_closed("torus_surface", nu, nv);
  Mesh mesh;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const Eigen::Vector2d around = on_circle(i, nu), across = on_circle(j, nv);
      const double radius = 2.0 + across.x();
      mesh.points.emplace_back(radius * around.x(), radius * around.y(), across.y());
    }
  add_closed_quads(mesh, nu, nv, [](int j) { return j; });
  return mesh;
}

Mesh moebius_strip(int n) {
  require_at_least("moebius_strip", "n", n, 3);
  require_room("moebius_strip", CellKind::quadrilateral, n);
  Mesh mesh;
  // points 2i and 2i + 1 are the ends of rung i, which is turned by i / n of half a turn
  for (int i = 0; i < n; ++i)
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector2d around = on_circle(i, n), rung = on_circle(i, 2 * std::int64_t{n});
      const double radius = 2.0 + side * rung.x();
      mesh.points.emplace_back(radius * around.x(), radius * around.y(), side * rung.y());
    }
  for (int i = 0; i < n; ++i) {
    const auto here = 2 * static_cast<std::uint32_t>(i);
    if (i + 1 < n)
      add(mesh, CellKind::quadrilateral, here, here + 2, here + 3, here + 1);
    else
      add(mesh, CellKind::quadrilateral, here, 1, 0, here + 1);
  }
  return mesh;
}

Mesh klein_bottle(int nu, int nv) {
  require_closed("klein_bottle", nu, nv);
  Mesh mesh;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      // half a step off 0, where the figure of eight (sin t, sin 2t) meets itself; -j - 1/2 is then at nv - 1 - j
      const Eigen::Vector2d t = on_circle(2 * std::int64_t{j} + 1, 2 * std::int64_t{nv});
      const double a = t.y(), b = 2.0 * t.x() * t.y();
      const Eigen::Vector2d around = on_circle(i, nu), turn = on_circle(i, 2 * std::int64_t{nu});
      const double radius = 3.0 + (a * turn.x() - b * turn.y());
      mesh.points.emplace_back(radius * around.x(), radius * around.y(), a * turn.y() + b * turn.x());
    }
  // half a turn takes (sin t, sin 2t) to the point of -t
  add_closed_quads(mesh, nu, nv, [nv](int j) { return nv - 1 - j; });
  return mesh;
}

Mesh octasphere(int subdivisions) {
  if (subdivisions < 0 || subdivisions > 12)
    throw InputError(fmt::format("octasphere: subdivisions = {}, expected 0 to 12", subdivisions));
  Mesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    add(mesh, CellKind::triangle, k, (k + 1) % 4, 4);
    add(mesh, CellKind::triangle, (k + 1) % 4, k, 5);
  }
  for (int s = 0; s < subdivisions; ++s) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;  // by the edge's two points, the smaller one first
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b),
                                                    static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) {
        const Eigen::Vector3d p = mesh.points[a] + mesh.points[b];
        mesh.points.emplace_back(p / std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z()));
      }
      return at->second;
    };
    Mesh finer;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const std::array corner{mesh.cell(c)[0], mesh.cell(c)[1], mesh.cell(c)[2]};
      std::array<std::uint32_t, 3> mid{};
      for (std::size_t k = 0; k < 3; ++k) mid[k] = middle(corner[k], corner[(k + 1) % 3]);
      for (std::size_t k = 0; k < 3; ++k) add(finer, CellKind::triangle, corner[k], mid[k], mid[(k + 2) % 3]);
      add(finer, CellKind::triangle, mid[0], mid[1], mid[2]);
    }
    finer.points = std::move(mesh.points);
    mesh = std::move(finer);
  }
  return mesh;
}

}  // namespace dartboard
