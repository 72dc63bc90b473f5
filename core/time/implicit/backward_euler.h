#pragma once
// Backward Euler: order 1, and the most robust of the implicit methods.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// x1 = x0 + h v1, v1 = v0 + h a(x1, v1): one stage.
///
/// order   1; L-stable, amplitudes fall by 1/sqrt(1 + (h omega)^2) each step
/// source  Baraff, Witkin 1998, iterated to convergence
class BackwardEuler : public ImplicitIntegrator {
 public:
  explicit BackwardEuler(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
};

}  // namespace dartboard
