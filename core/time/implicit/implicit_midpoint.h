#pragma once
// The implicit midpoint rule.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// One stage of h/2 to the midpoint, and on by reflection: x1 = x0 + h w, v1 = 2 w - v0.
///
/// order   2; A-stable, nothing is damped; symplectic. Nonlinear stability is not unconditional
/// source  Hairer, Lubich, Wanner: Geometric numerical integration, chapter VI
class ImplicitMidpoint : public ImplicitIntegrator {
 public:
  explicit ImplicitMidpoint(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
};

}  // namespace dartboard
