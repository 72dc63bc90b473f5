#pragma once
// The classical Runge-Kutta method for undamped springs and free masses, written out: the least that a step can be.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/views/spring_ends.h"

namespace dartboard {

/// The bits of ClassicalRungeKutta on such a system: the same operations in the same order, and no others.
class PlainLoop {
 public:
  using Column = std::vector<Eigen::Vector3d>;

  void step(const std::vector<SpringEnds>& ends, const std::vector<UndampedSpring>& springs,
            const std::vector<double>& inverse_mass, Column& x, Column& v, double h) {
    const std::size_t n = x.size();
    for (auto* column : {&a_, &sum_x_, &sum_v_, &stage_x_, &stage_v_}) column->resize(n);
    accelerate(ends, springs, inverse_mass, x);
    for (std::size_t i = 0; i < n; ++i) {
      sum_x_[i] = v[i];
      sum_v_[i] = a_[i];
      stage_x_[i] = x[i] + (h / 2) * v[i];
      stage_v_[i] = v[i] + (h / 2) * a_[i];
    }
    for (const double reach : {h / 2, h}) {
      accelerate(ends, springs, inverse_mass, stage_x_);
      for (std::size_t i = 0; i < n; ++i) {
        sum_x_[i] += 2.0 * stage_v_[i];
        sum_v_[i] += 2.0 * a_[i];
        stage_x_[i] = x[i] + reach * stage_v_[i];
        stage_v_[i] = v[i] + reach * a_[i];
      }
    }
    accelerate(ends, springs, inverse_mass, stage_x_);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = x[i] + (h / 6) * (sum_x_[i] + stage_v_[i]);
      v[i] = v[i] + (h / 6) * (sum_v_[i] + a_[i]);
    }
  }

 private:
  void accelerate(const std::vector<SpringEnds>& ends, const std::vector<UndampedSpring>& springs,
                  const std::vector<double>& inverse_mass, const Column& x) {
    for (Eigen::Vector3d& a : a_) a = Eigen::Vector3d(0, 0, 0);
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const auto [i, j] = ends[s];
      const Eigen::Vector3d dx = x[j] - x[i];
      const double length = std::sqrt(dx.squaredNorm());
      if (length == 0.0) continue;
      const Eigen::Vector3d f = (springs[s].stiffness * (length - springs[s].rest_length) * (1.0 / length)) * dx;
      a_[i] += f;
      a_[j] -= f;
    }
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] = a_[i] * inverse_mass[i];
  }

  Column a_, sum_x_, sum_v_, stage_x_, stage_v_;
};

}  // namespace dartboard
