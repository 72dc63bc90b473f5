#pragma once
// The energy-momentum method: implicit midpoint with a discrete gradient.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// As the implicit midpoint rule, with spring forces whose work over the step is exactly the elastic energy lost.
///
/// Energy, linear and angular momentum are conserved to the accuracy that the equations are solved to. Their Jacobian
/// is unsymmetric; its symmetric part near the midpoint takes its place. Equations are solved to rounding by default.
/// order   2; A-stable
/// source  LaBudde, Greenspan 1976; Gonzalez 1996; Simo, Tarnow 1992
class EnergyMomentum : public ImplicitIntegrator {
 public:
  explicit EnergyMomentum(const ImplicitOptions& options = to_rounding()) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;

  static ImplicitOptions to_rounding() {
    ImplicitOptions options;
    options.tolerance = 0.0;
    return options;
  }
};

}  // namespace dartboard
