#pragma once
// Force terms whose pieces are a few springs between a few vertices.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/forces/compensated_sum.h"
#include "core/forces/force_size.h"
#include "core/forces/force_term.h"
#include "core/forces/rows_of_part.h"

namespace dartboard {

/// One of these springs, between corners a and b of its piece.
struct PieceSpring {
  std::size_t a, b;
  double rest_length, stiffness;  // [m], [N/m]
};

/// A linear spring as a function of the line d between its ends: energy k (l - L)^2 / 2, and no force at zero length.
struct SpringLine {
  double rest_length, stiffness;

  double energy(const Eigen::Vector3d& d) const {
    const double stretch = d.norm() - rest_length;
    return 0.5 * stiffness * stretch * stretch;
  }
  /// The force on the first end.
  Eigen::Vector3d force(const Eigen::Vector3d& d) const {
    const double length = d.norm();
    if (length == 0.0) return Eigen::Vector3d::Zero();
    return (stiffness * (length - rest_length) / length) * d;
  }
  /// The change of energy from d to d + move. With l1 - l0 = move . (2 d + move) / (l0 + l1), nothing cancels.
  EnergyChange change(const Eigen::Vector3d& d, const Eigen::Vector3d& move) const {
    const double before = d.norm(), both = before + (d + move).norm();
    if (both == 0.0) return {};
    const double longer = move.dot(2.0 * d + move) / both, stretch = before - rest_length;
    return {stiffness * longer * (stretch + 0.5 * longer),
            stiffness * std::abs(longer) * (std::abs(stretch) + 0.5 * std::abs(longer))};
  }
  /// The energy is a function of the squared length: the quotient of their changes, along the mean line, is exact.
  Eigen::Vector3d discrete_force(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const double both = from.norm() + to.norm();
    if (both == 0.0) return Eigen::Vector3d::Zero();
    return (stiffness * (0.5 * both - rest_length) / both) * (from + to);
  }
  Eigen::Matrix3d tangent(const Eigen::Vector3d& d, Compression compression) const {
    const double length = d.norm();
    if (length == 0.0) return stiffness * Eigen::Matrix3d::Identity();
    double across = stiffness * ((length - rest_length) / length);
    if (compression == Compression::projected) across = std::max(across, 0.0);
    const Eigen::Vector3d u = d / length;
    return across * Eigen::Matrix3d::Identity() + (stiffness - across) * (u * u.transpose());
  }
};

/// The force term of `Pieces`, which has name(), size(), nodes(piece) and for_each(piece, f(PieceSpring)); and, to be
/// taken in parts, of_part(pieces, part).
template <class Pieces>
class SpringPieces final : public ForceTerm {
 public:
  using Vector3d = Eigen::Vector3d;
  using Matrix3d = Eigen::Matrix3d;

  explicit SpringPieces(Pieces pieces) : pieces_(std::move(pieces)) {}

  std::string_view pieces_name() const override { return pieces_.name(); }
  std::size_t size() const override { return pieces_.size(); }
  Nodes nodes(std::size_t piece) const override { return pieces_.nodes(piece); }

  void add_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for_each_spring([&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      const Vector3d f = spring.force(at.line(i, j));
      force[i] += f;
      force[j] -= f;
    });
  }
  void add_discrete_forces(const StagePlaces& at, std::span<Vector3d> force) const override {
    for_each_spring([&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      const Vector3d from = at.x[j] - at.x[i];
      const Vector3d f = spring.discrete_force(from, from + (2.0 * at.t) * (at.w[j] - at.w[i]));
      force[i] += f;
      force[j] -= f;
    });
  }
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for_each_spring([&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      const double bound = spring.stiffness * (line_size(at, i, j) + spring.rest_length);
      size[i] += bound;
      size[j] += bound;
    });
  }

  double energy(std::span<const Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t piece = first; piece < size(); piece += stride)
      for_each_of(piece, [&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
        sum.add(spring.energy(x[j] - x[i]));
      });
    return sum.value();
  }
  EnergyChange energy_change(const StagePlaces& at, std::span<const Vector3d> step, double scale) const override {
    EnergyChange sum;
    for_each_spring([&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      const EnergyChange change = spring.change(at.line(i, j), scale * (step[j] - step[i]));
      sum.value += change.value;
      sum.sizes += change.sizes;
    });
    return sum;
  }
  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t piece : pieces)
      for_each_of(piece, [&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
        sum -= spring.force(x[j] - x[i]).dot(w[j] - w[i]);
      });
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    for_each_stiffness(visit, [&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      return spring.tangent(at.line(i, j), compression);
    });
  }
  void for_each_constant_tangent(const VisitTangent& visit) const override {
    for_each_stiffness(visit, [](std::uint32_t, std::uint32_t, const SpringLine& spring) -> Matrix3d {
      return spring.stiffness * Matrix3d::Identity();
    });
  }

  /// The virial of its springs, shared equally among its vertices.
  Virial virial(std::span<const Vector3d> x, std::size_t piece) const override {
    const Nodes n = nodes(piece);
    Matrix3d sum = Matrix3d::Zero();
    for_each_of(piece, [&](std::uint32_t i, std::uint32_t j, const SpringLine& spring) {
      const Vector3d line = x[j] - x[i], f = spring.force(line);
      sum += f * line.transpose();
    });
    return {(0.5 / static_cast<double>(std::max<std::size_t>(1, n.size()))) * (sum + sum.transpose())};
  }
  TermOfPart of_part(const VertexSubset& part) const override {
    if constexpr (requires { pieces_.of_part(std::vector<std::uint32_t>(), part); })
      return pieces_.of_part(pieces_of_part(*this, part), part);
    return {};
  }

 private:
  static constexpr std::size_t most_nodes = 8;

  template <class F>
  void for_each_of(std::size_t piece, F&& f) const {
    const Nodes n = nodes(piece);
    pieces_.for_each(piece, [&](const PieceSpring& s) { f(n[s.a], n[s.b], SpringLine{s.rest_length, s.stiffness}); });
  }
  template <class F>
  void for_each_spring(F&& f) const {
    for (std::size_t piece = 0, count = size(); piece < count; ++piece) for_each_of(piece, f);
  }
  template <class Stiffness>
  void for_each_stiffness(const VisitTangent& visit, const Stiffness& stiffness) const {
    std::array<Matrix3d, most_nodes*(most_nodes + 1) / 2> blocks;
    for (std::size_t piece = 0; piece < size(); ++piece) {
      const Nodes n = nodes(piece);
      if (n.empty()) continue;
      const std::size_t count = n.size() * (n.size() + 1) / 2;
      std::fill_n(blocks.begin(), count, Matrix3d::Zero());
      const auto place = [](std::size_t a, std::size_t b) { return a * (a + 1) / 2 + b; };
      pieces_.for_each(piece, [&](const PieceSpring& s) {
        const Matrix3d k = stiffness(n[s.a], n[s.b], SpringLine{s.rest_length, s.stiffness});
        blocks[place(s.a, s.a)] += k;
        blocks[place(s.b, s.b)] += k;
        blocks[place(std::max(s.a, s.b), std::min(s.a, s.b))] -= k;
      });
      visit(n, std::span(blocks).first(count));
    }
  }

  Pieces pieces_;
};

}  // namespace dartboard
