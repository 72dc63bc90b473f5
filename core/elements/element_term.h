#pragma once
// Finite elements as a force term: all sums over cells and their Gauss points, for solids and for surfaces.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/base/lanes.h"
#include "core/forces/compensated_sum.h"
#include "core/forces/force_size.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// The lines [m] from the first corner of a cell to the others.
template <std::size_t most>
struct CornerLines {
  std::array<Eigen::Vector3d, most> to;
  template <class Corners>
  CornerLines(const StagePlaces& at, const Corners& n) {
    for (std::size_t a = 1; a < n.size(); ++a) to[a] = at.line(n[0], n[a]);
  }
  const Eigen::Vector3d& operator()(std::size_t a) const { return to[a]; }
};

/// A Gauss point: the gradients [1/m] of the shape functions by the d coordinates of the cell at rest.
template <int d, std::size_t most>
struct GaussPoint {
  std::size_t count;  // of corners
  std::array<Eigen::Matrix<double, d, 1>, most> gradient;

  explicit GaussPoint(std::size_t corners) : count(corners) {}  // gradients have to be set
  const Eigen::Matrix<double, d, 1>& operator[](std::size_t a) const { return gradient[a]; }
  /// sum line_a g_a', which is F for places, as the gradients add up to nothing.
  template <class Line>
  Eigen::Matrix<double, 3, d> deformation(const Line& line) const {
    Eigen::Matrix<double, 3, d> f = Eigen::Matrix<double, 3, d>::Zero();
    for (std::size_t a = 1; a < count; ++a) f += line(a) * gradient[a].transpose();
    return f;
  }
};

/// Elements of d = 2 or 3 dimensions. At each Gauss point the energy is the size that the point stands for times that
/// of the law of its cell at F.
///
/// Laws has laws_[c] with energy, change, stress, hessian, modulus and, by a function of its own, discrete_stress.
/// Cells has `d`, `most` corners of a cell, name(), size(), nodes(c), and for_each_point(laws, c, f), which calls
/// f(point, size) with points as GaussPoint. An optional add_stresses_in_lanes(law, c, lines, sums) adds the stresses
/// of the first points, several at a time (SIMD), and returns how many; for_each_point(laws, c, f, first) handles the
/// rest.
template <class Cells, class Laws>
class ElementTerm : public ForceTerm {
 public:
  ElementTerm(Laws laws, Cells cells) : laws_(std::move(laws)), cells_(std::move(cells)) {}

  std::string_view pieces_name() const override { return Cells::name(); }
  std::size_t size() const override { return cells_.size(); }
  Nodes nodes(std::size_t piece) const override { return cells_.nodes(piece); }

  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) add_forces_of(c, at, everywhere, force);
  }
  bool adds_in_parts() const override { return true; }
  void add_forces_in_part(const StagePlaces& at, PieceRun run, VertexRange own,
                          std::span<Eigen::Vector3d> force) const override {
    for (std::size_t c = run.first; c < run.last; ++c)
      if (run.whole)
        add_forces_of(c, at, everywhere, force);
      else
        add_forces_of(
            c, at, [own](std::uint32_t vertex) { return own.contains(vertex); }, force);
  }

  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override {
    for (std::size_t c = 0; c < size(); ++c) {
      const Lines from({at.x}, cells_.nodes(c)), move({at.w}, cells_.nodes(c));
      Sums sum = no_sums();
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        add_stress(volume * discrete_stress(laws_[c], point.deformation(from), (2.0 * at.t) * point.deformation(move)),
                   point, sum);
      });
      add_to_corners(c, sum, everywhere, force);
    }
  }

  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto n = cells_.nodes(c);
      const Lines lines(at, n);
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        double summed = 0.0;
        for (std::size_t a = 1; a < n.size(); ++a) summed += line_size(at, n[0], n[a]) * point[a].norm();
        const double stress = stress_size(laws_[c].modulus(), summed, point.deformation(lines).norm());
        for (std::size_t a = 0; a < n.size(); ++a) size[n[a]] += volume * stress * point[a].norm();
      });
    }
  }

  double energy(std::span<const Eigen::Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t c = first; c < size(); c += stride) {
      const Lines lines({x}, cells_.nodes(c));
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        sum.add(volume * laws_[c].energy(point.deformation(lines)));
      });
    }
    return sum.value();
  }

  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step,
                             double scale) const override {
    EnergyChange sum;
    for (std::size_t c = 0; c < size(); ++c) {
      const Lines from(at, cells_.nodes(c)), move({step}, cells_.nodes(c));
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        const EnergyChange change = laws_[c].change(point.deformation(from), scale * point.deformation(move));
        sum.value += volume * change.value;
        sum.sizes += volume * change.sizes;
      });
    }
    return sum;
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t c : pieces) {
      const Lines lines({x}, cells_.nodes(c)), moving({w}, cells_.nodes(c));
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        const auto stress = laws_[c].stress(point.deformation(lines)).eval();
        sum -= volume * stress.cwiseProduct(point.deformation(moving)).sum();
      });
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    Blocks blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = cells_.nodes(c);
      const Lines lines(at, n);
      std::ranges::fill(blocks, Eigen::Matrix3d::Zero());
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        const auto hessian = laws_[c].hessian(point.deformation(lines), compression);
        for (std::size_t b = 0; b < n.size(); ++b) {
          const auto along = columns_along(hessian, point[b], volume);
          for (std::size_t a = b; a < n.size(); ++a) add_rows_along(along, point[a], blocks[a * (a + 1) / 2 + b]);
        }
      });
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

  void for_each_constant_tangent(const VisitTangent& visit) const override {
    Blocks blocks;
    for (std::size_t c = 0; c < size(); ++c) {
      const auto n = cells_.nodes(c);
      std::ranges::fill(blocks, Eigen::Matrix3d::Zero());
      cells_.for_each_point(laws_, c, [&](const auto& point, double volume) {
        for (std::size_t a = 0, k = 0; a < n.size(); ++a)
          for (std::size_t b = 0; b <= a; ++b, ++k)
            blocks[k] += (volume * laws_[c].modulus() * point[a].dot(point[b])) * Eigen::Matrix3d::Identity();
      });
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

 protected:
  using Lines = CornerLines<Cells::most>;

  Laws laws_;
  Cells cells_;

 private:
  using Blocks = std::array<Eigen::Matrix3d, Cells::most*(Cells::most + 1) / 2>;
  using Gradient = Eigen::Matrix<double, Cells::d, 1>;

  /// Size times the three columns of a Hessian along a gradient.
  template <class Hessian>
  static Eigen::Matrix<double, 3 * Cells::d, 3> columns_along(const Hessian& h, const Gradient& g, double size) {
    if constexpr (Cells::d == 3)
      return size * (g[0] * h.template middleCols<3>(0) + g[1] * h.template middleCols<3>(3) +
                     g[2] * h.template middleCols<3>(6));
    else
      return size * (g[0] * h.template middleCols<3>(0) + g[1] * h.template middleCols<3>(3));
  }
  /// block += the three rows of such columns along a gradient.
  static void add_rows_along(const Eigen::Matrix<double, 3 * Cells::d, 3>& columns, const Gradient& g,
                             Eigen::Matrix3d& block) {
    if constexpr (Cells::d == 3)
      block += g[0] * columns.template middleRows<3>(0) + g[1] * columns.template middleRows<3>(3) +
               g[2] * columns.template middleRows<3>(6);
    else
      block += g[0] * columns.template middleRows<3>(0) + g[1] * columns.template middleRows<3>(3);
  }

  static constexpr auto everywhere = [](std::uint32_t) { return true; };

  using Sums = std::array<Eigen::Vector3d, Cells::most>;  // [N] by corner
  static Sums no_sums() {
    Sums sum;
    sum.fill(Eigen::Vector3d::Zero());
    return sum;
  }

  /// At the corners for which `is_own` holds.
  template <class IsOwn>
  void add_forces_of(std::size_t c, const StagePlaces& at, const IsOwn& is_own,
                     std::span<Eigen::Vector3d> force) const {
    const Lines lines(at, cells_.nodes(c));
    Sums sum = no_sums();
    const auto add_at = [&](const auto& point, double volume) {
      add_stress(volume * laws_[c].stress(point.deformation(lines)), point, sum);
    };
    if constexpr (requires { cells_.add_stresses_in_lanes(laws_[c], c, lines.to, sum); })
      cells_.for_each_point(laws_, c, add_at,
                            lanes_are_on() ? cells_.add_stresses_in_lanes(laws_[c], c, lines.to, sum) : 0);
    else
      cells_.for_each_point(laws_, c, add_at);
    add_to_corners(c, sum, is_own, force);
  }

  /// Adds the stress at a point, times its size, to all corners but the first.
  template <class Point>
  static void add_stress(const Eigen::Matrix<double, 3, Cells::d>& weighted, const Point& point, Sums& sum) {
    for (std::size_t a = 1; a < point.count; ++a) sum[a] += weighted * point[a];
  }

  template <class IsOwn>
  void add_to_corners(std::size_t c, Sums& sum, const IsOwn& is_own, std::span<Eigen::Vector3d> force) const {
    const auto n = cells_.nodes(c);
    // the force on the first corner is minus the sum of the others: rounding changes no momentum
    for (std::size_t a = 1; a < n.size(); ++a) {
      sum[0] += sum[a];
      if (is_own(n[a])) force[n[a]] -= sum[a];
    }
    if (is_own(n[0])) force[n[0]] += sum[0];
  }
};

/// The sum over the points of a cell of size P F', shared equally by its corners, and the growth of the cell.
///
/// `for_each_point` calls f(point, size); `growth(law, F)` is the present size over that at rest, less 1.
template <class Law, class ForEachPoint, class Line, class Growth>
Virial virial_share(const Law& law, std::size_t count, const ForEachPoint& for_each_point, const Line& line,
                    const Growth& growth_of) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double growth = 0.0;
  for_each_point([&](const auto& point, double size) {
    const auto f = point.deformation(line);
    sum += size * (law.stress(f) * f.transpose());
    growth += size * growth_of(law, f);
  });
  return {(0.5 / static_cast<double>(count)) * (sum + sum.transpose()), growth / static_cast<double>(count)};
}

}  // namespace dartboard
