#pragma once
// The explicit Euler method: a baseline for comparison only.

#include <vector>

#include "core/time/method/trial_state.h"

namespace dartboard {

/// x += h v, v += h a(x, v): amplifies every undamped oscillation, whatever the step.
class ExplicitEuler : public Integrator {
 public:
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override { terms_.forget(); }
  std::size_t bytes() const override { return end_.bytes() + terms_.bytes(); }

 private:
  KnownTerms terms_;
  TrialState end_;
};

}  // namespace dartboard
