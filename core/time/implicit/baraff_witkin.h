#pragma once
// The linearly implicit Euler method of Baraff and Witkin.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// One Newton iteration of backward Euler from w = 0, that is linearised at the start of the step:
/// (M + h C + h^2 K) v1 = M v0 + h f(x0, 0).
///
/// order   1; linearly as stable as backward Euler. There is no globalisation: large steps of stiff bodies may diverge
/// cost    one solution per step, and one factorisation unless a kept factor serves
/// source  Baraff, Witkin: Large steps in cloth simulation, 1998
class BaraffWitkin : public ImplicitIntegrator {
 public:
  explicit BaraffWitkin(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  void motion_changed() override { terms_.forget(); }
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  std::size_t bytes() const override { return ImplicitIntegrator::bytes() + bytes_of(right_, solution_); }

 private:
  KnownTerms terms_;
  std::vector<Eigen::Vector3d> right_, solution_;
};

}  // namespace dartboard
