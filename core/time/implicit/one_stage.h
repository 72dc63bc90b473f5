#pragma once
// The methods of one implicit stage: backward Euler, its local/global form, the midpoint rule, energy-momentum.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// The properties that distinguish methods of one stage.
struct OneStageMethod {
  enum class End {
    of_step,   // a stage of h: v1 = w, x1 = x0 + h w
    midpoint,  // a stage of h/2, and on by reflection: v1 = 2 w - v0, x1 = x0 + h w
  };
  Scheme scheme;
  End end;
  StageForce force;
};

/// An integrator whose step is one stage.
class OneStage : public ImplicitIntegrator {
 public:
  OneStage(const OneStageMethod& method, const ImplicitOptions& options)
      : ImplicitIntegrator(options), method_(method) {}

  const Scheme& scheme() const override { return method_.scheme; }
  StepResult step(const SpringSystem& system, Motion motion, double h) override;

 private:
  const OneStageMethod& method_;
};

/// x1 = x0 + h v1, v1 = v0 + h a(x1, v1): the most robust of the implicit methods.
///
/// order   1; L-stable, amplitudes fall by 1/sqrt(1 + (h omega)^2) each step
/// source  Baraff, Witkin 1998, iterated to convergence
class BackwardEuler : public OneStage {
 public:
  explicit BackwardEuler(const ImplicitOptions& options = {});
};

/// Iterations on backward Euler with the constant matrix m + h c + h^2 k of the spring graph: each is the projection of
/// all springs to their rest length (local) and one solution (global). The matrix bounds the Jacobian, so every
/// iteration lowers the incremental potential; nothing is factored until h or the topology changes.
///
/// order   1, if the iterations suffice; L-stable
/// source  Liu, Bargteil, O'Brien, Kavan 2013
class LocalGlobal : public OneStage {
 public:
  explicit LocalGlobal(int iterations = 20);
  static ImplicitOptions with_iterations(int iterations);
};

/// The implicit midpoint rule.
///
/// order   2; A-stable, nothing is damped; symplectic. Nonlinear stability is not unconditional
/// source  Hairer, Lubich, Wanner: Geometric numerical integration, chapter VI
class ImplicitMidpoint : public OneStage {
 public:
  explicit ImplicitMidpoint(const ImplicitOptions& options = {});
};

/// As the implicit midpoint rule, with spring forces whose work over the step is exactly the elastic energy lost.
///
/// Energy, linear and angular momentum are conserved to the accuracy that the equations are solved to. Their Jacobian
/// is unsymmetric; its symmetric part near the midpoint takes its place. Equations are solved to rounding by default.
/// order   2; A-stable
/// source  LaBudde, Greenspan 1976; Gonzalez 1996; Simo, Tarnow 1992
class EnergyMomentum : public OneStage {
 public:
  explicit EnergyMomentum(const ImplicitOptions& options = to_rounding());
  static ImplicitOptions to_rounding();
};

}  // namespace dartboard
