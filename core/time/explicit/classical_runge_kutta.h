#pragma once
// The classical Runge-Kutta method of order 4 on arrays: the bits of RungeKutta4, which runs over walks.

#include "core/time/explicit/padded_runge_kutta.h"
#include "core/time/method/trial_state.h"

namespace dartboard {

/// Order 4, four force evaluations; damping costs only its terms in the forces.
class ClassicalRungeKutta : public Integrator {
 public:
  /// With padded rows where these can be, or never: the bits are the same.
  explicit ClassicalRungeKutta(bool may_pad = true) : may_pad_(may_pad) {}
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override { terms_.forget(); }
  std::size_t bytes() const override {
    return stage_.bytes() + bytes_of(a_, sum_x_, sum_v_) + padded_.bytes() + terms_.bytes();
  }

 private:
  StepResult step_by_threes(const SpringSystem& system, const Terms& terms, Motion motion, double h);

  bool may_pad_;
  KnownTerms terms_;
  PaddedRungeKutta padded_;  // the only columns in use, or empty
  TrialState stage_;
  std::vector<Eigen::Vector3d> a_, sum_x_, sum_v_;  // acceleration of the stage, weighted sums over the stages
};

}  // namespace dartboard
