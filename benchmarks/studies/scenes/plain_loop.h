#pragma once
// The classical Runge-Kutta method for undamped springs and free masses, written out: the least that a step can be
// with one spring at a time.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/views/spring_ends.h"

namespace dartboard {

/// Leaves the bits of ClassicalRungeKutta on such a system: the same operations in the same order, and no others.
///
/// Columns are read through pointers of the loop's own: Eigen stores pairs of doubles by a type that may alias any
/// other, so that whatever is reached through a vector would be looked up again after each of them.
class PlainLoop {
 public:
  using Column = std::vector<Eigen::Vector3d>;

  /// `springs` have a rest length and a stiffness; other members are ignored.
  template <class SpringRow>
  void step(const std::vector<SpringEnds>& ends, const std::vector<SpringRow>& springs,
            const std::vector<double>& inverse_mass, Column& position, Column& velocity, double h) {
    const std::size_t n = position.size();
    for (auto* column : {&a_, &sum_x_, &sum_v_, &stage_x_, &stage_v_}) column->resize(n);
    Eigen::Vector3d *const x = position.data(), *const v = velocity.data(), *const a = a_.data(),
                           *const sum_x = sum_x_.data(), *const sum_v = sum_v_.data(), *const stage_x = stage_x_.data(),
                           *const stage_v = stage_v_.data();
    const auto accelerate = [n, count = springs.size(), end = ends.data(), spring = springs.data(),
                             inverse = inverse_mass.data(), a](const Eigen::Vector3d* at) {
      add_up(count, end, spring, at, n, a);
      for (std::size_t i = 0; i < n; ++i) a[i] = a[i] * inverse[i];
    };
    accelerate(x);
    for (std::size_t i = 0; i < n; ++i) {
      sum_x[i] = v[i];
      sum_v[i] = a[i];
      stage_x[i] = x[i] + (h / 2) * v[i];
      stage_v[i] = v[i] + (h / 2) * a[i];
    }
    for (const double reach : {h / 2, h}) {
      accelerate(stage_x);
      for (std::size_t i = 0; i < n; ++i) {
        sum_x[i] += 2.0 * stage_v[i];
        sum_v[i] += 2.0 * a[i];
        stage_x[i] = x[i] + reach * stage_v[i];
        stage_v[i] = v[i] + reach * a[i];
      }
    }
    accelerate(stage_x);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = x[i] + (h / 6) * (sum_x[i] + stage_v[i]);
      v[i] = v[i] + (h / 6) * (sum_v[i] + a[i]);
    }
  }

 private:
  template <class SpringRow>
  static void add_up(std::size_t count, const SpringEnds* ends, const SpringRow* springs, const Eigen::Vector3d* x,
                     std::size_t n, Eigen::Vector3d* force) {
    std::fill_n(force, n, Eigen::Vector3d(0, 0, 0));
    for (std::size_t s = 0; s < count; ++s) {
      const auto [i, j] = ends[s];
      const Eigen::Vector3d dx = x[j] - x[i];
      const double length = std::sqrt(dx.squaredNorm());
      if (length == 0.0) continue;
      const Eigen::Vector3d f = (springs[s].stiffness * (length - springs[s].rest_length) * (1.0 / length)) * dx;
      force[i] += f;
      force[j] -= f;
    }
  }

  Column a_, sum_x_, sum_v_, stage_x_, stage_v_;
};

}  // namespace dartboard
