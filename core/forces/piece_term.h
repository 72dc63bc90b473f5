#pragma once
// A force term from the energy, the force and the tangent of one piece: all sums are written here.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "core/forces/compensated_sum.h"
#include "core/forces/force_term.h"
#include "core/forces/semidefinite.h"

namespace dartboard {

/// Pieces of 1 to 8 vertices. In the functions of a piece k, x [m] has a place for each of its vertices.
template <class T>
concept Pieces = requires(const T& pieces, std::size_t k, std::span<const Eigen::Vector3d> x,
                          std::span<Eigen::Vector3d> force, std::span<Eigen::Matrix3d> blocks) {
  /// Do forces act between the vertices of a piece alone, so that they depend on differences of places only?
  { T::is_internal } -> std::convertible_to<bool>;
  { pieces.name() } -> std::convertible_to<std::string_view>;
  { pieces.size() } -> std::convertible_to<std::size_t>;
  { pieces.nodes(k) } -> std::convertible_to<ForceTerm::Nodes>;
  /// [J] zero at rest.
  { pieces.energy(k, x) } -> std::convertible_to<double>;
  /// force[a] += - dE/dx_a [N]
  pieces.add_forces(k, x, force);
  /// blocks[a (a + 1) / 2 + b] += d2E/dx_a dx_b [N/m] for b <= a, negative eigenvalues included.
  pieces.add_tangent(k, x, blocks);
  /// [N/m] At least the largest eigenvalue of the whole tangent near rest.
  { pieces.stiffness(k) } -> std::convertible_to<double>;
};

/// All sums over pieces. What a term with closed forms of its own does better: changes of energy are differences of
/// energies; discrete forces keep the energy and, of internal pieces, the linear momentum, but not the angular one.
///
/// cost  as those of the pieces; an eigenvalue decomposition for each tangent that is projected
template <Pieces P>
class PieceTerm final : public ForceTerm {
 public:
  explicit PieceTerm(P pieces) : pieces_(std::move(pieces)) {}

  const P& pieces() const { return pieces_; }
  P& pieces() { return pieces_; }

  std::string_view pieces_name() const override { return pieces_.name(); }
  std::size_t size() const override { return pieces_.size(); }
  Nodes nodes(std::size_t piece) const override { return pieces_.nodes(piece); }

  void add_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override {
    for (std::size_t k = 0; k < size(); ++k) add(k, forces_at(k, Places(at, nodes(k))), force);
  }

  // The forces half way, and what is left of the energy along the motion.
  void add_discrete_forces(const StagePlaces& at, std::span<Eigen::Vector3d> force) const override {
    for (std::size_t k = 0; k < size(); ++k) {
      const Nodes n = nodes(k);
      const Places start({at.x}, n), middle(at, n), end({at.x, at.w, 2.0 * at.t}, n);
      Eight f = forces_at(k, middle), moved;
      Eigen::Vector3d mean(0, 0, 0);
      for (std::size_t a = 0; a < n.size(); ++a) {
        moved[a] = (2.0 * at.t) * at.w[n[a]];
        mean += moved[a] / static_cast<double>(n.size());
      }
      double work = 0.0, squares = 0.0;
      for (std::size_t a = 0; a < n.size(); ++a) {
        work += f[a].dot(moved[a]);
        if (P::is_internal) moved[a] -= mean;
        squares += moved[a].squaredNorm();
      }
      const double before = pieces_.energy(k, start), after = pieces_.energy(k, end), lacking = before - after - work;
      // what is left is not only rounding
      if (std::abs(lacking) > 8.0 * epsilon * (std::abs(before) + std::abs(after) + std::abs(work)) && squares > 0.0)
        for (std::size_t a = 0; a < n.size(); ++a) f[a] += (lacking / squares) * moved[a];
      add(k, f, force);
    }
  }

  // A place that is rounded by a unit moves the force by the tangent; the sum of the force itself is rounded too, and
  // the energies of discrete forces, over the way between them.
  void add_force_sizes(const StagePlaces& at, std::span<double> size) const override {
    for (std::size_t k = 0; k < this->size(); ++k) {
      const Nodes n = nodes(k);
      const Places places(at, n);
      const Eight f = forces_at(k, places);
      const Blocks blocks = tangent_at(k, places);
      double of_energies = 0.0;
      if (!at.w.empty()) {
        double squares = 0.0;
        for (const std::uint32_t i : n) squares += (2.0 * at.t * at.w[i]).squaredNorm();
        const Places start({at.x}, n), end({at.x, at.w, 2.0 * at.t}, n);
        if (squares > 0.0)
          of_energies = (std::abs(pieces_.energy(k, start)) + std::abs(pieces_.energy(k, end))) / std::sqrt(squares);
      }
      for (std::size_t a = 0; a < n.size(); ++a) {
        size[n[a]] += f[a].norm() + of_energies;
        for (std::size_t b = 0; b < n.size(); ++b) size[n[a]] += block(blocks, a, b).norm() * reach(at, n, b);
      }
    }
  }

  double energy(std::span<const Eigen::Vector3d> x, std::size_t first, std::size_t stride) const override {
    CompensatedSum sum;
    for (std::size_t k = first; k < size(); k += stride) sum.add(pieces_.energy(k, Places({x}, nodes(k))));
    return sum.value();
  }

  EnergyChange energy_change(const StagePlaces& at, std::span<const Eigen::Vector3d> step,
                             double scale) const override {
    EnergyChange sum;
    for (std::size_t k = 0; k < size(); ++k) {
      const Nodes n = nodes(k);
      Places places(at, n);
      const double before = pieces_.energy(k, places);
      for (std::size_t a = 0; a < n.size(); ++a) places.x[a] += scale * step[n[a]];
      const double after = pieces_.energy(k, places);
      sum.value += after - before;
      sum.sizes += std::abs(after) + std::abs(before);
    }
    return sum;
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Eigen::Vector3d> x,
               std::span<const Eigen::Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t k : pieces) {
      const Eight f = forces_at(k, Places({x}, nodes(k)));
      for (std::size_t a = 0; a < nodes(k).size(); ++a) sum += f[a].dot(w[nodes(k)[a]]);
    }
    return sum;
  }

  void for_each_tangent(const StagePlaces& at, Compression compression, const VisitTangent& visit) const override {
    for (std::size_t k = 0; k < size(); ++k) {
      const Nodes n = nodes(k);
      Blocks blocks = tangent_at(k, Places(at, n));
      if (compression == Compression::projected)
        make_semidefinite({blocks.data(), n.size() * (n.size() + 1) / 2}, n.size());
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

  void for_each_constant_tangent(const VisitTangent& visit) const override {
    for (std::size_t k = 0; k < size(); ++k) {
      Blocks blocks = zero();
      const Nodes n = nodes(k);
      for (std::size_t a = 0; a < n.size(); ++a)
        blocks[a * (a + 3) / 2] = pieces_.stiffness(k) * Eigen::Matrix3d::Identity();
      visit(n, {blocks.data(), n.size() * (n.size() + 1) / 2});
    }
  }

  /// - sum f_a (x_a - x_0)', shared equally by the vertices; zero of forces from outside.
  Virial virial(std::span<const Eigen::Vector3d> x, std::size_t k) const override {
    Virial share;
    if (!P::is_internal) return share;
    const Places places({x}, nodes(k));
    const Eight f = forces_at(k, places);
    for (std::size_t a = 1; a < places.count; ++a) share.tensor -= f[a] * (places.x[a] - places.x[0]).transpose();
    share.tensor = (0.5 / static_cast<double>(places.count)) * (share.tensor + share.tensor.transpose()).eval();
    return share;
  }

 private:
  using Eight = std::array<Eigen::Vector3d, 8>;
  using Blocks = std::array<Eigen::Matrix3d, 36>;
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  struct Places {
    Eight x;
    std::size_t count;
    Places(const StagePlaces& at, Nodes n) : count(n.size()) {
      for (std::size_t a = 0; a < count; ++a) x[a] = at.w.empty() ? at.x[n[a]] : at.x[n[a]] + at.t * at.w[n[a]];
    }
    operator std::span<const Eigen::Vector3d>() const { return {x.data(), count}; }
  };

  static Blocks zero() {
    Blocks blocks;
    blocks.fill(Eigen::Matrix3d::Zero());
    return blocks;
  }
  static Eigen::Matrix3d block(const Blocks& blocks, std::size_t a, std::size_t b) {
    return a >= b ? blocks[a * (a + 1) / 2 + b] : Eigen::Matrix3d(blocks[b * (b + 1) / 2 + a].transpose());
  }
  Eight forces_at(std::size_t k, const Places& places) const {
    Eight f;
    f.fill(Eigen::Vector3d(0, 0, 0));
    pieces_.add_forces(k, places, std::span(f.data(), places.count));
    return f;
  }
  Blocks tangent_at(std::size_t k, const Places& places) const {
    Blocks blocks = zero();
    pieces_.add_tangent(k, places, std::span(blocks.data(), places.count * (places.count + 1) / 2));
    return blocks;
  }
  void add(std::size_t k, const Eight& f, std::span<Eigen::Vector3d> force) const {
    const Nodes n = nodes(k);
    for (std::size_t a = 0; a < n.size(); ++a) force[n[a]] += f[a];
  }
  /// [m] The size of the numbers that vertex b of a piece is placed by.
  static double reach(const StagePlaces& at, Nodes n, std::size_t b) {
    const double moved = at.w.empty() ? 0.0 : std::abs(at.t) * at.w[n[b]].norm();
    return moved + (P::is_internal ? at.x[n[b]] - at.x[n[0]] : at.x[n[b]]).norm();
  }
  P pieces_;
};

}  // namespace dartboard
