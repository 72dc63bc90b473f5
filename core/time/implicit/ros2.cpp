#include "core/time/implicit/ros2.h"

#include <cmath>

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_ros2{
    .name = "ros2",
    .what = "Rosenbrock method of two stages, any Jacobian",
    .order = 2,
    .stages = 2,
    .implicit = true,
    .linearized = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = two_stage_amplification,
    .source = "Verwer, Spee, Blom, Hundsdorfer 1999",
};

}  // namespace

const Scheme& Ros2::scheme() const { return scheme_of_ros2; }

// (I - tau J) (kx, kv) = (rx, rv): kx = rx + tau kv, so (M + tau C + tau^2 K) kv = M rv - tau K rx.
bool Ros2::solve_stage(const SpringSystem& system, double tau) {
  StepSolver& solver = stage_.solver();
  if (status_ != SolveStatus::ok) return false;
  multiply_stiffness(system, solver.tangents(), rx_, kx_);
  solver.matrix().add_stiffness_of_terms(rx_, kx_);
  for (std::size_t i = 0; i < kx_.size(); ++i)
    right_[i] = system.fixed[i] ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(system.mass[i] * rv_[i] - tau * kx_[i]);
  status_ = solver.solve(right_, kv_, Accuracy::full, work_);
  for (std::size_t i = 0; i < kx_.size(); ++i) kx_[i] = rx_[i] + tau * kv_[i];
  return status_ == SolveStatus::ok;
}

StepResult Ros2::step(const SpringSystem& system, Motion motion, double h) {
  const double tau = (1.0 - 1.0 / std::sqrt(2.0)) * h;
  const std::size_t n = motion.x.size();
  end_.resize(n);
  for (auto* column : {&right_, &k1x_, &k1v_, &kx_, &kv_, &rx_, &rv_}) column->resize(n);
  StepSolver& solver = stage_.solver();
  solver.begin_step(work_);
  const TangentsAt tangents{[&system, motion](Compression compression, std::vector<SpringTangent>& result) {
                              evaluate_tangents(system, motion.x, compression, result);
                            },
                            {motion.x}};
  status_ = SolveStatus::ok;
  const Terms terms = terms_.of(system);
  for (bool again = true; again;) {
    again = false;
    status_ = solver.prepare(system, tangents, tau, work_);
    accelerations(system, terms, motion.x, motion.v, rv_);
    for (std::size_t i = 0; i < n; ++i) rx_[i] = motion.v[i];
    if (solve_stage(system, tau)) {
      k1x_ = kx_;
      k1v_ = kv_;
      for (std::size_t i = 0; i < n; ++i) {
        end_.x[i] = motion.x[i] + h * kx_[i];
        end_.v[i] = motion.v[i] + h * kv_[i];
      }
      accelerations(system, terms, end_.x, end_.v, rv_);
      for (std::size_t i = 0; i < n; ++i) {
        rx_[i] = end_.v[i] - 2.0 * k1x_[i];
        rv_[i] -= 2.0 * k1v_[i];
      }
      solve_stage(system, tau);
    }
    work_.force_evaluations += 2;
    if (status_ == SolveStatus::not_positive_definite && !solver.is_projecting()) {
      solver.project(work_);
      again = true;
    }
  }
  if (status_ != SolveStatus::ok) return fail(diagnosis_of(status_, solver));
  for (std::size_t i = 0; i < n; ++i) {
    end_.x[i] = motion.x[i] + h * (1.5 * k1x_[i] + 0.5 * kx_[i]);
    end_.v[i] = motion.v[i] + h * (1.5 * k1v_[i] + 0.5 * kv_[i]);
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
