#include "core/elements/tetrahedra.h"

#include <Eigen/LU>
#include <algorithm>
#include <type_traits>
#include <variant>

#include "core/base/lanes.h"
#include "core/elements/element_term.h"
#include "core/elements/lanes/material_runs.h"
#include "core/elements/lanes/tetrahedra_lanes.h"
#include "core/elements/part_of_elements.h"
#include "core/elements/tetrahedra_damping.h"
#include "core/elements/with_law.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The one Gauss point of a tetrahedron.
GaussPoint<3, 4> point_of(const RestShape& shape) {
  GaussPoint<3, 4> point(4);
  for (int a = 0; a < 3; ++a) point.gradient[static_cast<std::size_t>(a) + 1] = shape.row(a);
  point.gradient[0] = -(point[1] + point[2] + point[3]);
  return point;
}

template <class Law, class Line>
Virial share_of(const Law& law, double volume, const RestShape& shape, const Line& line) {
  return virial_share(
      law, 4, [&](const auto& f) { f(point_of(shape), volume); }, line,
      [](const auto& of, const Matrix3d& f) { return volume_ratio(of, f) - 1.0; });
}

class TetrahedronCells {
 public:
  static constexpr int d = 3;
  static constexpr std::size_t most = 4;
  explicit TetrahedronCells(const TetrahedronColumns& columns) : columns_(columns) {}

  static std::string_view name() { return "tetrahedra"; }
  std::size_t size() const { return columns_.nodes.size(); }
  std::span<const std::uint32_t, 4> nodes(std::size_t c) const { return columns_.nodes[c]; }
  template <class Laws, class F>
  void for_each_point(const Laws& laws, std::size_t c, F&& f) const {
    f(point_of(columns_.shape[c]), volume(laws, c));
  }
  template <class Laws>
  double volume(const Laws& laws, std::size_t c) const {
    return laws.per_mass(c) * columns_.mass[c];
  }

 private:
  TetrahedronColumns columns_;
};

/// Elements whose forces have loops of their own: four tetrahedra at a time, or each without its Gauss point.
template <class Laws>
class Tetrahedra final : public ElementTerm<TetrahedronCells, Laws> {
  using Base = ElementTerm<TetrahedronCells, Laws>;
  using Base::cells_, Base::laws_, Base::size;

 public:
  Tetrahedra(const Laws& laws, const CellMaterials& materials, const TetrahedronColumns& columns)
      : Base(laws, TetrahedronCells(columns)),
        materials_(materials),
        columns_(columns),
        damping_(make_tetrahedra_damping(materials, columns)) {}

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    add_forces_of(at, 0, size(), force);
  }
  void add_forces_in_part(const StagePlaces& at, PieceRun run, VertexRange own,
                          std::span<Vector3d> force) const override {
    if (run.whole)
      add_forces_of(at, run.first, run.last, force);
    else
      add_forces_of(
          at, run.first, run.last, [own](std::uint32_t vertex) { return own.contains(vertex); }, force);
  }

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    return share_of(laws_[c], cells_.volume(laws_, c), columns_.shape[c], CornerLines<4>({x}, columns_.nodes[c]));
  }
  const TermDamping* damping() const override { return damping_.get(); }

  TermOfPart of_part(const VertexSubset& part) const override {
    return part_of_elements(*this, materials_, columns_, part);
  }

 private:
  static Matrix3d gradient(std::span<const Vector3d> x, const TetrahedronNodes& n, const Matrix3d& shape) {
    const Vector3d origin = x[n[0]];
    Matrix3d edges;
    edges << x[n[1]] - origin, x[n[2]] - origin, x[n[3]] - origin;
    return edges * shape;
  }
  static Matrix3d gradient(const StagePlaces& at, const TetrahedronNodes& n, const Matrix3d& shape) {
    Matrix3d edges;
    edges << at.line(n[0], n[1]), at.line(n[0], n[2]), at.line(n[0], n[3]);
    return edges * shape;
  }
  static constexpr auto everywhere = [](std::uint32_t) { return true; };

  /// At the corners for which `is_own` holds.
  template <class IsOwn>
  static void add_force(const TetrahedronNodes& n, const Matrix3d& shape, const Matrix3d& weighted, const IsOwn& is_own,
                        std::span<Vector3d> force) {
    const Matrix3d f = weighted * shape.transpose();
    if (is_own(n[0])) force[n[0]] -= f.col(0) + f.col(1) + f.col(2);
    if (is_own(n[1])) force[n[1]] += f.col(0);
    if (is_own(n[2])) force[n[2]] += f.col(1);
    if (is_own(n[3])) force[n[3]] += f.col(2);
  }
  /// At all corners, four tetrahedra of one material at a time where that is possible.
  void add_forces_of(const StagePlaces& at, std::size_t first, std::size_t last, std::span<Vector3d> force) const {
    while (first < last) {
      const std::size_t end = end_of_material(materials_, first, last);
      std::size_t next = end;
      if (at.w.empty() && end - first >= 4 && lanes_are_on()) {
        first = add_in_lanes(laws_[first], at.x, first, end, force);
        next = std::min(first + 4, end);
      }
      add_forces_of(at, first, next, everywhere, force);
      first = next;
    }
  }
  /// Tetrahedra of one law. Returns the first that was not added.
  template <class Law>
  std::size_t add_in_lanes(const Law& law, std::span<const Vector3d> x, std::size_t first, std::size_t last,
                           std::span<Vector3d> force) const {
    if constexpr (std::is_same_v<Law, AnyLaw>) {
      return std::visit([&](const auto& one) { return add_in_lanes(one, x, first, last, force); }, law.law());
    } else if constexpr (std::is_same_v<Law, NoLaw>) {
      return first;
    } else {
      const TetrahedraAt columns{
          columns_.nodes.data(), columns_.shape.data(), columns_.mass.data(), laws_.per_mass(first), x.data(),
          force.data()};
      return add_forces_in_lanes(columns, law.constants(), first, last);
    }
  }
  template <class IsOwn>
  void add_forces_of(const StagePlaces& at, std::size_t first, std::size_t last, const IsOwn& is_own,
                     std::span<Vector3d> force) const {
    if (at.w.empty())
      add_forces_of([&at](const TetrahedronNodes& n, const Matrix3d& shape) { return gradient(at.x, n, shape); }, first,
                    last, is_own, force);
    else
      add_forces_of([&at](const TetrahedronNodes& n, const Matrix3d& shape) { return gradient(at, n, shape); }, first,
                    last, is_own, force);
  }
  /// Inlined whole, however large the other functions of this source are.
  template <class Gradient, class IsOwn>
  [[gnu::flatten]] void add_forces_of(const Gradient& gradient_of, std::size_t first, std::size_t last,
                                      const IsOwn& is_own, std::span<Vector3d> force) const {
    const TetrahedronNodes* const nodes = columns_.nodes.data();
    const Matrix3d* const shape = columns_.shape.data();
    const double* const mass = columns_.mass.data();
    for (std::size_t c = first; c < last; ++c) {
      const Matrix3d stress = laws_[c].stress(gradient_of(nodes[c], shape[c]));
      add_force(nodes[c], shape[c], (-laws_.per_mass(c) * mass[c]) * stress, is_own, force);
    }
  }

  CellMaterials materials_;
  TetrahedronColumns columns_;
  std::unique_ptr<TermDamping> damping_;
};

}  // namespace

RestShape rest_shape_of(const Vector3d& x0, const Vector3d& x1, const Vector3d& x2, const Vector3d& x3) {
  Matrix3d edges;
  edges << x1 - x0, x2 - x0, x3 - x0;
  // by cofactors, column by column: as exact for slivers as the determinant is
  return cofactors(edges).transpose() / edges.row(0).dot(cofactors(edges).row(0));
}

std::unique_ptr<ForceTerm> make_tetrahedra(const CellMaterials& materials, const TetrahedronColumns& columns) {
  return with_laws_of(materials, [&]<class Laws>(const Laws& laws) -> std::unique_ptr<ForceTerm> {
    return std::make_unique<Tetrahedra<Laws>>(laws, materials, columns);
  });
}

Virial tetrahedron_virial(const Material& material, double mass, const RestShape& shape,
                          const std::array<Vector3d, 4>& x) {
  const double volume = 1.0 / material.density * mass;
  const auto line = [&x](std::size_t a) -> Vector3d { return x[a] - x[0]; };
  if (material.model == Model::springs) return share_of(NoLaw(), volume, shape, line);
  return with_law_of(material, [&](const auto& law) { return share_of(law, volume, shape, line); });
}

}  // namespace dartboard
