#pragma once
// The classical Runge-Kutta method of order 4 on arrays: the bits of RungeKutta4, which runs over walks.

#include "core/time/method/trial_state.h"

namespace dartboard {

/// Order 4, four force evaluations; damping costs only its terms in the forces.
class ClassicalRungeKutta : public Integrator {
 public:
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override { terms_.forget(); }
  std::size_t bytes() const override { return stage_.bytes() + bytes_of(a_, sum_x_, sum_v_) + terms_.bytes(); }

 private:
  KnownTerms terms_;
  TrialState stage_;
  std::vector<Eigen::Vector3d> a_, sum_x_, sum_v_;  // acceleration of the stage, weighted sums over the stages
};

}  // namespace dartboard
