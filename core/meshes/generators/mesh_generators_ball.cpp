#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/meshes/generators/mesh_generator_parts.h"
#include "core/meshes/generators/mesh_generators.h"

namespace dartboard {

using namespace detail;

namespace {

using Eigen::Vector3i;

/// The points of the octahedron |x| + |y| + |z| <= n with whole coordinates: x fastest, then y, then z.
class OctahedralLattice {
 public:
  explicit OctahedralLattice(int n)
      : n_(n), row_(static_cast<std::size_t>(2 * n + 1) * static_cast<std::size_t>(2 * n + 1)) {
    for (int z = -n; z <= n; ++z)
      for (int y = -n; y <= n; ++y) {
        row_[row(y, z)] = static_cast<std::uint32_t>(points_.size());
        const int reach = n - std::abs(y) - std::abs(z);
        for (int x = -reach; x <= reach; ++x) points_.emplace_back(x, y, z);
      }
  }
  const std::vector<Vector3i>& points() const { return points_; }
  std::uint32_t number(const Vector3i& p) const {
    const int reach = n_ - std::abs(p.y()) - std::abs(p.z());
    return row_[row(p.y(), p.z())] + static_cast<std::uint32_t>(p.x() + reach);
  }

 private:
  std::size_t row(int y, int z) const { return static_cast<std::size_t>((z + n_) * (2 * n_ + 1) + y + n_); }

  int n_;
  std::vector<std::uint32_t> row_;  // number of the first point of each row along x
  std::vector<Vector3i> points_;
};

/// Adds tetrahedra by lattice points, turned so that they are right-handed.
struct BallCells {
  Mesh& mesh;
  const OctahedralLattice& lattice;

  void add_tetrahedron(const Vector3i& a, const Vector3i& b, Vector3i c, Vector3i d) {
    Eigen::Matrix3i edges;
    edges << b - a, c - a, d - a;
    if (edges.determinant() < 0) std::swap(c, d);
    add(mesh, CellKind::tetrahedron, lattice.number(a), lattice.number(b), lattice.number(c), lattice.number(d));
  }

  /// Adds an octahedron by three pairs of opposite points: four tetrahedra around its (first) shortest diagonal.
  void add_octahedron(const std::array<std::array<Vector3i, 2>, 3>& pairs) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const double length =
          (mesh.points[lattice.number(pairs[k][0])] - mesh.points[lattice.number(pairs[k][1])]).squaredNorm();
      if (length < least) best = k;
      if (length < least) least = length;
    }
    const auto &diagonal = pairs[best], &one = pairs[(best + 1) % 3], &other = pairs[(best + 2) % 3];
    const std::array ring{one[0], other[0], one[1], other[1]};
    for (std::size_t k = 0; k < 4; ++k) add_tetrahedron(diagonal[0], diagonal[1], ring[k], ring[(k + 1) % 4]);
  }
};

}  // namespace

Mesh tetrahedron_ball(int layers, double radius) {
  require_at_least("tetrahedron_ball", "layers", layers, 1);
  if (!(radius > 0.0 && std::isfinite(radius)))
    throw InputError(fmt::format("tetrahedron_ball: radius = {}, expected a finite number > 0", radius));
  require_room("tetrahedron_ball", CellKind::tetrahedron, 8.0 * layers * layers * layers);
  const OctahedralLattice lattice(layers);
  Mesh mesh;
  for (const Vector3i& p : lattice.points()) {
    const int layer = p.cwiseAbs().sum();
    const double length = std::sqrt(static_cast<double>(p.squaredNorm()));
    const double factor = layer == 0 ? 0.0 : radius * layer / (layers * length);
    mesh.points.emplace_back(factor * p.cast<double>());
  }
  BallCells cells{mesh, lattice};
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3i sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    for (int z = 0; z < layers; ++z)
      for (int y = 0; y < layers - z; ++y)
        for (int x = 0; x < layers - z - y; ++x) {
          const auto at = [&](int dx, int dy, int dz) -> Vector3i {
            return Vector3i(x + dx, y + dy, z + dz).cwiseProduct(sign);
          };
          // the planes x + y + z = k + 1 and k + 2 cut the cube in a corner, an octahedron and a corner
          const int inside = layers - x - y - z;
          cells.add_tetrahedron(at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1));
          if (inside >= 2)
            cells.add_octahedron(
                {{{at(1, 0, 0), at(0, 1, 1)}, {at(0, 1, 0), at(1, 0, 1)}, {at(0, 0, 1), at(1, 1, 0)}}});
          if (inside >= 3) cells.add_tetrahedron(at(1, 1, 1), at(1, 1, 0), at(1, 0, 1), at(0, 1, 1));
        }
  }
  return mesh;
}

}  // namespace dartboard
