#pragma once
// The prefactored local/global method of backward Euler.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// Iterations on backward Euler with the constant matrix m + h c + h^2 k of the spring graph: each is the projection of
/// all springs to their rest length (local) and one solution (global). The matrix bounds the Jacobian, so every
/// iteration lowers the incremental potential; nothing is factored until h or the topology changes.
///
/// order   1, if the iterations suffice; L-stable
/// source  Liu, Bargteil, O'Brien, Kavan 2013
class LocalGlobal : public ImplicitIntegrator {
 public:
  explicit LocalGlobal(int iterations = 20) : ImplicitIntegrator(with_iterations(iterations)) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;

  static ImplicitOptions with_iterations(int iterations) {
    ImplicitOptions options;
    options.solver = LinearSolver::laplacian;
    options.max_iterations = iterations;
    options.iterate_once = true;
    return options;
  }
};

}  // namespace dartboard
