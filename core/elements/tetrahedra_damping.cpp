#include "core/elements/tetrahedra_damping.h"

#include "core/elements/lanes/tetrahedra_lanes.h"
#include "core/elements/strain_damping.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The one Gauss point of each tetrahedron.
class TetrahedronPoints {
 public:
  explicit TetrahedronPoints(const TetrahedronColumns& columns) : columns_(columns) {}
  std::size_t size() const { return columns_.nodes.size(); }
  std::span<const std::uint32_t, 4> nodes(std::size_t piece) const { return columns_.nodes[piece]; }
  static std::size_t points(std::size_t) { return 1; }
  double place(std::size_t piece, std::size_t, const DampedMaterial& material, std::array<Vector3d, 8>& g) const {
    const RestShape& shape = columns_.shape[piece];
    g[1] = shape.row(0);
    g[2] = shape.row(1);
    g[3] = shape.row(2);
    g[0] = -(g[1] + g[2] + g[3]);
    return material.per_mass * columns_.mass[piece];
  }
  std::size_t add_forces_in_lanes(const DampedMaterial& m, std::size_t first, std::size_t last,
                                  std::span<const Vector3d> x, std::span<const Vector3d> v,
                                  std::span<Vector3d> force) const {
    const TetrahedraAt at{columns_.nodes.data(), columns_.shape.data(), columns_.mass.data(), m.per_mass, x.data(),
                          force.data()};
    return add_damping_in_lanes(at, v.data(), {2.0 * m.mu * m.time, m.lambda * m.time}, first, last);
  }

 private:
  TetrahedronColumns columns_;
};

}  // namespace

std::unique_ptr<TermDamping> make_tetrahedra_damping(const CellMaterials& materials,
                                                     const TetrahedronColumns& columns) {
  auto damping = std::make_unique<StrainDamping<TetrahedronPoints>>(materials, TetrahedronPoints(columns));
  return damping->any() ? std::move(damping) : nullptr;
}

}  // namespace dartboard
