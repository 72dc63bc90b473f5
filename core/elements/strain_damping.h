#pragma once
// The damping of elements by the rate of their strain, written once for every kind of element.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "core/base/lanes.h"
#include "core/elements/elastic_laws.h"
#include "core/elements/lanes/material_runs.h"
#include "core/forces/force_size.h"
#include "core/forces/one_minus_exp.h"
#include "core/forces/term_damping.h"
#include "core/plain/cell_materials.h"
#include "core/plain/material.h"

namespace dartboard {

/// The properties of a cell's material that the damping of its element needs.
struct DampedMaterial {
  double mu, lambda;  // [Pa]; zero for cells of springs
  double time;        // [s]
  double per_mass;    // [m^3/kg], the volume of a kilogram
};

/// The damped materials of a body's cells.
class DampedMaterials {
 public:
  explicit DampedMaterials(const CellMaterials& materials) : materials_(materials) {
    for (const Material& m : materials.all()) {
      const Lame lame = m.model == Model::springs ? Lame{0.0, 0.0} : lame_of(m.young, m.poisson);
      all_.push_back({lame.mu, lame.lambda, m.model == Model::springs ? 0.0 : m.damping_time, 1.0 / m.density});
      any_ = any_ || all_.back().time != 0.0;
    }
    if (!any_) all_ = {};
  }
  bool any() const { return any_; }
  std::size_t end_of_material(std::size_t first, std::size_t last) const {
    return dartboard::end_of_material(materials_, first, last);
  }
  const DampedMaterial& operator[](std::size_t cell) const {
    return all_[materials_.is_one() ? 0 : materials_.number(cell)];
  }

 private:
  CellMaterials materials_;
  std::vector<DampedMaterial> all_;
  bool any_ = false;
};

/// Stiffness-proportional damping that is zero for rotations (Kelvin and Voigt): to the second Piola-Kirchhoff stress
/// it adds
///
///     S = time (2 mu E' + lambda tr(E') I),   E' = sym(F' dF/dt), the rate of Green's strain
///
/// Near rest that is `time` times the elasticity acting on velocities, whatever the law: every oscillation has the
/// damping ratio omega time / 2.
///
/// `Points` gives the elements, piece by piece and Gauss point by Gauss point:
///   size(), nodes(piece) (a span, of fixed size where all are alike), points(piece), and place(piece, point, material,
///   gradients): the gradients [1/m] of the functions of the corners at rest, and the volume [m^3] that the point
///   stands for. Where it has them, add_forces_in_lanes(material, x, v, force): the forces of the first elements of a
///   body of one material, several at a time, and their number; or add_stresses_in_lanes(material, piece, lines,
///   speeds, sums): those of the first points, and their number
/// source  Simo, Hughes: Computational Inelasticity, 1998, chapter 10, on viscoelasticity
template <class Points>
class StrainDamping final : public TermDamping {
 public:
  using Matrix3d = Eigen::Matrix3d;
  using Vector3d = Eigen::Vector3d;
  using Gradients = std::array<Vector3d, 8>;

  StrainDamping(const CellMaterials& materials, const Points& points) : materials_(materials), points_(points) {}

  bool any() const { return materials_.any(); }

  double time(std::size_t piece) const override { return materials_[piece].time; }

  void add_forces(const StagePlaces& at, std::span<const Vector3d> v, std::span<Vector3d> force) const override {
    const std::size_t size = points_.size();
    for (std::size_t piece = 0, end = 0; piece < size; piece = end) {
      end = materials_.end_of_material(piece, size);
      const DampedMaterial& m = materials_[piece];
      if (m.time == 0.0) continue;
      for (std::size_t k = add_forces_in_lanes(m, piece, end, at, v, force); k < end; ++k)
        add_forces_of(k, m, at, v, force);
    }
  }

  void add_force_sizes(const StagePlaces& at, std::span<const Vector3d> v, std::span<double> size) const override {
    for_each_damped([&](std::size_t piece, const DampedMaterial& m) {
      const auto n = points_.nodes(piece);
      for_each_point(piece, m, 0, [&](const Gradients& g, double volume) {
        double deformed = 0.0, rate = 0.0;
        for (std::size_t a = 1; a < n.size(); ++a) {
          deformed += line_size(at, n[0], n[a]) * g[a].norm();
          rate += (v[n[a]] - v[n[0]]).norm() * g[a].norm();
        }
        const double most = m.time * (2.0 * m.mu + 3.0 * std::abs(m.lambda)) * deformed * deformed * rate;
        for (std::size_t a = 0; a < n.size(); ++a) size[n[a]] += volume * most * g[a].norm();
      });
    });
  }

  double power(std::span<const std::uint32_t> pieces, std::span<const Vector3d> x, std::span<const Vector3d> v,
               std::span<const Vector3d> w) const override {
    double sum = 0.0;
    for (const std::uint32_t piece : pieces) {
      const DampedMaterial& m = materials_[piece];
      const auto n = points_.nodes(piece);
      for_each_point(piece, m, 0, [&](const Gradients& g, double volume) {
        const Matrix3d f = gradient(x, n, g);
        const Matrix3d s = stress(m, strain_rate(f, gradient(v, n, g)));
        sum -= volume * s.cwiseProduct(strain_rate(f, gradient(w, n, g))).sum();
      });
    }
    return sum;
  }

  EnergyChange rate_change(const StagePlaces& at, std::span<const Vector3d> v, std::span<const Vector3d> step,
                           double scale) const override {
    EnergyChange sum;
    for_each_damped([&](std::size_t piece, const DampedMaterial& m) {
      const auto n = points_.nodes(piece);
      for_each_point(piece, m, 0, [&](const Gradients& g, double volume) {
        const Matrix3d f = gradient(at, n, g);
        const Matrix3d rate = strain_rate(f, gradient(v, n, g));
        const Matrix3d more = scale * strain_rate(f, gradient(step, n, g));
        const double change = volume * stress(m, rate + 0.5 * more).cwiseProduct(more).sum();
        sum.value += change;
        sum.sizes += std::abs(change);
      });
    });
    return sum;
  }

  // The block of corners a and b is V (mu (g_a . g_b) F F' + mu q_b q_a' + lambda q_a q_b') with q = F g.
  void for_each_tangent(const StagePlaces& at, const VisitTangent& visit) const override {
    std::array<Matrix3d, 36> blocks;
    std::array<Vector3d, 8> q;
    for (std::size_t piece = 0; piece < points_.size(); ++piece) {
      const DampedMaterial& m = materials_[piece];
      const auto n = points_.nodes(piece);
      const std::size_t count = n.size() * (n.size() + 1) / 2;
      std::fill_n(blocks.begin(), count, Matrix3d::Zero());
      for_each_point(piece, m, 0, [&](const Gradients& g, double volume) {
        const Matrix3d f = gradient(at, n, g);
        const Matrix3d square = f * f.transpose();
        for (std::size_t a = 0; a < n.size(); ++a) q[a] = f * g[a];
        for (std::size_t a = 0, k = 0; a < n.size(); ++a)
          for (std::size_t b = 0; b <= a; ++b, ++k)
            blocks[k] += volume * (m.mu * (g[a].dot(g[b]) * square + q[b] * q[a].transpose()) +
                                   m.lambda * (q[a] * q[b].transpose()));
      });
      visit(n, {blocks.data(), count});
    }
  }

  void decay(std::span<const Vector3d> x, double h, const Mobility& mobility, bool backwards,
             std::span<Vector3d> v) const override {
    const std::size_t count = points_.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t piece = backwards ? count - 1 - k : k;
      const DampedMaterial& m = materials_[piece];
      if (m.time == 0.0) continue;
      const auto n = points_.nodes(piece);
      std::array<double, 8> mobile;
      std::array<HeldAxes, 8> held;
      std::array<Vector3d, 8> speed;
      bool any_held = false;
      for (std::size_t a = 0; a < n.size(); ++a) {
        mobile[a] = mobility[n[a]];
        speed[a] = v[n[a]];
        held[a] = mobility.held_axes(n[a]);
        any_held = any_held || held[a] != 0;
      }
      Gradients g;
      const std::size_t points = points_.points(piece);
      for (std::size_t j = 0; j < points; ++j) {
        const double volume = points_.place(piece, backwards ? points - 1 - j : j, m, g);
        const Matrix3d f = gradient(x, n, g);
        const double shape = (h * m.time * volume) * 2.0 * m.mu,
                     bulk = (h * m.time * volume) * (2.0 * m.mu + 3.0 * m.lambda);
        any_held ? decay_at<true>(f, g, n, shape, bulk, mobile, held, backwards, speed)
                 : decay_at<false>(f, g, n, shape, bulk, mobile, held, backwards, speed);
      }
      for (std::size_t a = 0; a < n.size(); ++a)
        if (mobile[a] != 0.0) v[n[a]] = speed[a];
    }
  }

 private:
  /// Of pieces of one material. Returns the first whose forces it has not added.
  std::size_t add_forces_in_lanes(const DampedMaterial& m, std::size_t first, std::size_t last, const StagePlaces& at,
                                  std::span<const Vector3d> v, std::span<Vector3d> force) const {
    if constexpr (requires { points_.add_forces_in_lanes(m, first, last, at.x, v, force); })
      if (at.w.empty() && lanes_are_on()) return points_.add_forces_in_lanes(m, first, last, at.x, v, force);
    return first;
  }
  void add_forces_of(std::size_t piece, const DampedMaterial& m, const StagePlaces& at, std::span<const Vector3d> v,
                     std::span<Vector3d> force) const {
    const auto n = points_.nodes(piece);
    std::array<Vector3d, 8> sum;
    std::fill_n(sum.begin(), n.size(), Vector3d::Zero());
    for_each_point(piece, m, points_in_lanes(piece, m, at, v, sum), [&](const Gradients& g, double volume) {
      const Matrix3d f = gradient(at, n, g);
      const Matrix3d weighted = volume * (f * stress(m, strain_rate(f, gradient(v, n, g))));
      for (std::size_t a = 1; a < n.size(); ++a) sum[a] += weighted * g[a];
    });
    // the force on the first corner is minus the sum of the others: rounding changes no momentum
    for (std::size_t a = 1; a < n.size(); ++a) {
      sum[0] += sum[a];
      force[n[a]] -= sum[a];
    }
    force[n[0]] += sum[0];
  }

  /// f(piece, material)
  template <class F>
  void for_each_damped(F&& f) const {
    for (std::size_t piece = 0; piece < points_.size(); ++piece)
      if (const DampedMaterial& m = materials_[piece]; m.time != 0.0) f(piece, m);
  }
  /// The number of the first points of a piece whose stresses it has added to the sums of the corners but the first.
  std::size_t points_in_lanes(std::size_t piece, const DampedMaterial& m, const StagePlaces& at,
                              std::span<const Vector3d> v, std::array<Vector3d, 8>& sum) const {
    std::array<Vector3d, 8> lines, speeds;
    if constexpr (requires { points_.add_stresses_in_lanes(m, piece, lines, speeds, sum); }) {
      if (!lanes_are_on()) return 0;
      const auto n = points_.nodes(piece);
      for (std::size_t a = 1; a < n.size(); ++a) {
        lines[a] = at.line(n[0], n[a]);
        speeds[a] = v[n[a]] - v[n[0]];
      }
      return points_.add_stresses_in_lanes(m, piece, lines, speeds, sum);
    }
    return 0;
  }
  /// f(gradients, volume), from a point on.
  template <class F>
  void for_each_point(std::size_t piece, const DampedMaterial& m, std::size_t first, F&& f) const {
    Gradients g;
    for (std::size_t point = first, count = points_.points(piece); point < count; ++point) {
      const double volume = points_.place(piece, point, m, g);
      f(g, volume);
    }
  }

  /// For places the gradient F, for velocities dF/dt.
  template <class SomeNodes>
  static Matrix3d gradient(const StagePlaces& at, const SomeNodes& n, const Gradients& g) {
    if (at.w.empty()) return gradient(at.x, n, g);
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t a = 1; a < n.size(); ++a) sum += at.line(n[0], n[a]) * g[a].transpose();
    return sum;
  }
  template <class SomeNodes>
  static Matrix3d gradient(std::span<const Vector3d> v, const SomeNodes& n, const Gradients& g) {
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t a = 1; a < n.size(); ++a) sum += (v[n[a]] - v[n[0]]) * g[a].transpose();
    return sum;
  }

  static Matrix3d strain_rate(const Matrix3d& f, const Matrix3d& rate) {
    const Matrix3d whole = f.transpose() * rate;
    return 0.5 * (whole + whole.transpose());
  }
  /// Second Piola-Kirchhoff [Pa].
  static Matrix3d stress(const DampedMaterial& m, const Matrix3d& strain_rate) {
    return (2.0 * m.mu * m.time) * strain_rate + (m.lambda * m.time * strain_rate.trace()) * Matrix3d::Identity();
  }

  /// F N g for six eigenstrains N of the stiffness, each of size 1: one of volume, two along the axes, three
  /// shears.
  static std::array<Vector3d, 6> arms(const Matrix3d& f, const Vector3d& g) {
    constexpr double third = std::numbers::inv_sqrt3, half = std::numbers::sqrt2 / 2.0, sixth = third * half;
    const Vector3d x = g[0] * f.col(0), y = g[1] * f.col(1), z = g[2] * f.col(2);
    return {third * (x + y + z),
            half * (x - y),
            sixth * (x + y - 2.0 * z),
            half * (g[2] * f.col(1) + g[1] * f.col(2)),
            half * (g[0] * f.col(2) + g[2] * f.col(0)),
            half * (g[1] * f.col(0) + g[0] * f.col(1))};
  }

  // Each of the six strains N is a damper of its own: its rate is sum_a b_a . v_a with b_a = F N g_a, which no rigid
  // motion has, and its force is along b. Alone it decays by exp(-c sum_a |b_a|^2 / m_a), c = h time V times 2 mu, or
  // 2 mu + 3 lambda for the volume. A corner that is held along axes has the part of b_a across these axes.
  template <bool any_held, class SomeNodes>
  static void decay_at(const Matrix3d& f, const Gradients& g, const SomeNodes& n, double shape, double volume,
                       const std::array<double, 8>& mobility, const std::array<HeldAxes, 8>& held, bool backwards,
                       std::array<Vector3d, 8>& v) {
    const auto free = [&](std::size_t a, const Vector3d& arm) -> Vector3d {
      if constexpr (any_held) return free_part(held[a], arm);
      return arm;
    };
    std::array<std::array<Vector3d, 6>, 8> b;
    for (std::size_t a = 1; a < n.size(); ++a) b[a] = arms(f, g[a]);
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t strain = backwards ? 5 - k : k;
      Vector3d first = Vector3d::Zero();
      double rate = 0.0, mobile = 0.0;
      for (std::size_t a = 1; a < n.size(); ++a) {
        first -= b[a][strain];
        rate += b[a][strain].dot(v[a] - v[0]);
        mobile += mobility[a] * free(a, b[a][strain]).squaredNorm();
      }
      mobile += mobility[0] * free(0, first).squaredNorm();
      if (mobile == 0.0) continue;
      const double impulse = one_minus_exp_of_minus((strain == 0 ? volume : shape) * mobile) / mobile * rate;
      v[0] -= (mobility[0] * impulse) * free(0, first);
      for (std::size_t a = 1; a < n.size(); ++a) v[a] -= (mobility[a] * impulse) * free(a, b[a][strain]);
    }
  }

  DampedMaterials materials_;
  Points points_;
};

}  // namespace dartboard
