#include "core/time/explicit/classical_runge_kutta.h"

namespace dartboard {
namespace {

Eigen::MatrixXd amplification(double theta, double zeta) {
  const Eigen::Matrix2d z = test_oscillator(theta, zeta), one = Eigen::Matrix2d::Identity();
  return one + z * (one + z / 2.0 * (one + z / 3.0 * (one + z / 4.0)));
}

const Scheme classical_runge_kutta{
    .name = "rk4",
    .what = "classical Runge-Kutta, the paper's integrator",
    .order = 4,
    .stages = 4,
    .imaginary_limit = 2.8284271247461903,  // 2 sqrt(2)
    .amplification = amplification,
    .source = "Kutta 1901; Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.1",
};

}  // namespace

const Scheme& ClassicalRungeKutta::scheme() const { return classical_runge_kutta; }

StepResult ClassicalRungeKutta::step(const SpringSystem& system, Motion motion, double h) {
  const Terms& terms = terms_.of(system);
  if (!may_pad_ || !PaddedRungeKutta::can_step(system)) {
    padded_ = {};
    return step_by_threes(system, terms, motion, h);
  }
  stage_ = {};
  for (auto* column : {&a_, &sum_x_, &sum_v_}) *column = std::vector<Eigen::Vector3d>();
  return padded_.step(system, terms, motion, h, work_);
}

StepResult ClassicalRungeKutta::step_by_threes(const SpringSystem& system, const Terms& terms, Motion motion,
                                               double h) {
  const std::size_t n = motion.x.size();
  stage_.resize(n);
  for (auto* column : {&a_, &sum_x_, &sum_v_}) column->resize(n);

  // by pointers, as in accelerations.cpp
  using Eigen::Vector3d;
  const Vector3d *const x = motion.x.data(), *const v = motion.v.data(), *const a = a_.data();
  Vector3d *const sum_x = sum_x_.data(), *const sum_v = sum_v_.data(), *const stage_x = stage_.x.data(),
                  *const stage_v = stage_.v.data();
  accelerations(system, terms, motion.x, motion.v, a_);
  terms.for_each_share(n, [=](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      sum_x[i] = v[i];
      sum_v[i] = a[i];
      stage_x[i] = x[i] + (h / 2) * v[i];
      stage_v[i] = v[i] + (h / 2) * a[i];
    }
  });
  for (const double reach : {h / 2, h}) {  // to the stage that follows
    accelerations(system, terms, stage_.x, stage_.v, a_);
    terms.for_each_share(n, [=](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        sum_x[i] += 2.0 * stage_v[i];
        sum_v[i] += 2.0 * a[i];
        stage_x[i] = x[i] + reach * stage_v[i];
        stage_v[i] = v[i] + reach * a[i];
      }
    });
  }
  accelerations(system, terms, stage_.x, stage_.v, a_);
  terms.for_each_share(n, [=](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      stage_x[i] = x[i] + (h / 6) * (sum_x[i] + stage_v[i]);
      stage_v[i] = v[i] + (h / 6) * (sum_v[i] + a[i]);
    }
  });
  work_.force_evaluations += 4;
  return stage_.commit(motion, work_);
}

}  // namespace dartboard
