#pragma once
// The Runge-Kutta pair of orders 5 and 4 by Dormand and Prince, with step-size control or with fixed steps.

#include <array>

#include "core/time/method/trial_state.h"

namespace dartboard {

/// Order 5, six force evaluations; a seventh, the first of the next step, estimates the error of `advance`.
class DormandPrince54 : public AdaptiveIntegrator {
 public:
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  StepResult advance(const SpringSystem& system, Motion motion, double duration, const Tolerance& tolerance) override;
  void restart() override;
  void state(Archive& archive) override {
    Integrator::state(archive);
    archive(next_step_, last_error_);
  }
  std::size_t bytes() const override;

  /// The step size `advance` will try first; 0 when it is to choose one.
  double next_step() const { return next_step_; }

 private:
  using Column = std::vector<Eigen::Vector3d>;

  void resize(std::size_t n);
  void evaluate_first(const SpringSystem& system, Motion motion);
  void evaluate_others(const SpringSystem& system, Motion motion, double h);
  double evaluate_error(const SpringSystem& system, double h, const Tolerance& tolerance);

  KnownTerms terms_;
  TrialState end_;
  std::array<Column, 7> stage_v_, stage_a_;  // the derivatives of x and v at the stages; the last is at the end
  Column stage_x_;
  double next_step_ = 0.0, last_error_ = 1.0;
};

}  // namespace dartboard
