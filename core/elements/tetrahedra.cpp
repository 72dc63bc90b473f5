#include "core/elements/tetrahedra.h"

#include <Eigen/LU>
#include <algorithm>
#include <type_traits>
#include <variant>

#include "core/base/lanes.h"
#include "core/elements/lanes/material_runs.h"
#include "core/elements/lanes/tetrahedra_lanes.h"
#include "core/elements/part_of_elements.h"
#include "core/elements/tetrahedra_damping.h"
#include "core/elements/with_law.h"
#include "core/forces/compensated_sum.h"
#include "core/forces/force_size.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// V P F' is the virial of an element: its volume now, V det F, times Cauchy's stress. A fourth of it for each corner.
template <class Law>
Virial virial_share(const Law& law, double volume, const Matrix3d& f) {
  const Matrix3d whole = (0.25 * volume) * (law.stress(f) * f.transpose());
  return {0.5 * (whole + whole.transpose()), 0.25 * volume * (volume_ratio(law, f) - 1.0)};
}

template <class Laws>
class Tetrahedra final : public ForceTerm {
 public:
  Tetrahedra(const Laws& laws, const CellMaterials& materials, const TetrahedronColumns& columns)
      : laws_(laws), materials_(materials), columns_(columns), damping_(make_tetrahedra_damping(materials, columns)) {}

  std::string_view pieces_name() const override { return "tetrahedra"; }
  std::size_t size() const override { return columns_.nodes.size(); }
  Nodes nodes(std::size_t piece) const override { return columns_.nodes[piece]; }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    add_forces_of(at, 0, size(), force);
  }
  bool adds_in_parts() const override { return true; }
  void add_forces_in_part(const StagePlaces& at, PieceRun run, VertexRange own,
                          std::span<Vector3d> force) const override {
    if (run.whole)
      add_forces_of(at, run.first, run.last, force);
    else
      add_forces_of(
          at, run.first, run.last, [own](std::uint32_t vertex) { return own.contains(vertex); }, force);
  }

  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const TetrahedronNodes& n = columns_.nodes[c];
      const Matrix3d from = gradient(at.x, n, columns_.shape[c]);
      const Matrix3d move = (2.0 * at.t) * gradient(at.w, n, columns_.shape[c]);
      add_force(n, columns_.shape[c], -volume(c) * discrete_stress(laws_[c], from, move), everywhere, force);
    }
  }

  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (std::size_t c = 0; c < columns_.nodes.size(); ++c) {
      const TetrahedronNodes& n = columns_.nodes[c];
      const auto gradients = shape_gradients(columns_.shape[c]);
      double summed = 0.0;
      for (std::size_t a = 1; a < 4; ++a) summed += line_size(at, n[0], n[a]) * gradients[a].norm();
      const double stress = stress_size(laws_[c].modulus(), summed, gradient(at, n, columns_.shape[c]).norm());
      for (std::size_t a = 0; a < 4; ++a) size[n[a]] += volume(c) * stress * gradients[a].norm();
    }
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t c = first; c < size(); c += stride)
      sum.add(volume(c) * laws_[c].energy(gradient(x, columns_.nodes[c], columns_.shape[c])));
    return sum.value();
  }

  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for (std::size_t c = 0; c < size(); ++c) {
      const TetrahedronNodes& n = columns_.nodes[c];
      const EnergyChange change =
          laws_[c].change(gradient(at, n, columns_.shape[c]), scale * gradient(step, n, columns_.shape[c]));
      sum.value += volume(c) * change.value;
      sum.sizes += volume(c) * change.sizes;
    }
    return sum;
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t c : pieces) {
      const TetrahedronNodes& n = columns_.nodes[c];
      const Matrix3d stress = laws_[c].stress(gradient(x, n, columns_.shape[c]));
      sum -= volume(c) * stress.cwiseProduct(gradient(w, n, columns_.shape[c])).sum();
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    std::array<Matrix3d, 10> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const TetrahedronNodes& n = columns_.nodes[c];
      const Hessian h = laws_[c].hessian(gradient(at, n, columns_.shape[c]), compression);
      const auto gradients = shape_gradients(columns_.shape[c]);
      const double v = volume(c);
      // along the gradient of each corner, three columns of the Hessian
      std::array<Eigen::Matrix<double, 9, 3>, 4> along;
      for (std::size_t b = 0; b < 4; ++b)
        along[b] = v * (gradients[b][0] * h.middleCols<3>(0) + gradients[b][1] * h.middleCols<3>(3) +
                        gradients[b][2] * h.middleCols<3>(6));
      for (std::size_t a = 0, k = 0; a < 4; ++a)
        for (std::size_t b = 0; b <= a; ++b)
          blocks[k++] = gradients[a][0] * along[b].middleRows<3>(0) + gradients[a][1] * along[b].middleRows<3>(3) +
                        gradients[a][2] * along[b].middleRows<3>(6);
      visit(n, blocks);
    }
  }

  void for_each_constant_tangent(const VisitTangent& visit) const override {
    std::array<Matrix3d, 10> blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto gradients = shape_gradients(columns_.shape[c]);
      for (std::size_t a = 0, k = 0; a < 4; ++a)
        for (std::size_t b = 0; b <= a; ++b)
          blocks[k++] = (volume(c) * laws_[c].modulus() * gradients[a].dot(gradients[b])) * Matrix3d::Identity();
      visit(columns_.nodes[c], blocks);
    }
  }

  Virial virial(std::span<const Vector3d> x, std::size_t c) const override {
    return virial_share(laws_[c], volume(c), gradient(x, columns_.nodes[c], columns_.shape[c]));
  }

  const TermDamping* damping() const override { return damping_.get(); }

  TermOfPart of_part(const VertexSubset& part) const override {
    return part_of_elements(*this, materials_, columns_, part);
  }

 private:
  double volume(std::size_t c) const { return laws_.per_mass(c) * columns_.mass[c]; }

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
  /// The gradients [1/m] of the linear functions that are 1 at one corner and 0 at the others.
  static std::array<Vector3d, 4> shape_gradients(const Matrix3d& shape) {
    const Vector3d one = shape.row(0), two = shape.row(1), three = shape.row(2);
    return {-(one + two + three), one, two, three};
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

  Laws laws_;
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
  Matrix3d edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const double volume = 1.0 / material.density * mass;
  const Matrix3d f = edges * shape;
  if (material.model == Model::springs) return virial_share(NoLaw(), volume, f);
  return with_law_of(material, [&](const auto& law) { return virial_share(law, volume, f); });
}

}  // namespace dartboard
