#pragma once
// The backward differentiation formula of order 2.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// x1 = (4 x0 - x-1)/3 + 2h/3 v1, likewise for v: one stage from an extrapolated start.
///
/// The first step, and the first after a restart or with another h, is one of backward Euler: its local error is of
/// order 2, so the method keeps its order.
/// order   2; L-stable
/// source  Curtiss, Hirschfelder 1952
class Bdf2 : public ImplicitIntegrator {
 public:
  explicit Bdf2(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  std::size_t bytes() const override { return ImplicitIntegrator::bytes() + last_.bytes() + start_.bytes(); }
  void motion_changed() override { last_h_ = 0.0; }
  void drives_changed() override { stage_.system_changed(); }
  void state(Archive& archive) override {
    ImplicitIntegrator::state(archive);
    archive(last_, last_h_);
  }

 private:
  TrialState last_, start_;  // the state before this one; the start of the stage
  double last_h_ = 0.0;
};

}  // namespace dartboard
