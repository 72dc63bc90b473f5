#pragma once
// The Rosenbrock method of two stages and order 2.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// (I - g h J) k1 = f(u), (I - g h J) k2 = f(u + h k1) - 2 k1, u1 = u + h (3/2 k1 + 1/2 k2), g = 1 - 1/sqrt(2).
///
/// Of order 2 whatever J is (a W-method), so a projected tangent, or one that neglects the turning of dampers, costs no
/// accuracy. There is no iteration, hence no globalisation: very stiff bodies may diverge.
/// order   2; L-stable
/// cost    two solutions and two force evaluations per step, and one factorisation unless a kept factor serves
/// source  Verwer, Spee, Blom, Hundsdorfer 1999
class Ros2 : public ImplicitIntegrator {
 public:
  explicit Ros2(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  void motion_changed() override { terms_.forget(); }
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  std::size_t bytes() const override {
    return ImplicitIntegrator::bytes() + bytes_of(right_, k1x_, k1v_, kx_, kv_, rx_, rv_);
  }

 private:
  bool solve_stage(const SpringSystem& system, double tau);

  KnownTerms terms_;
  std::vector<Eigen::Vector3d> right_, k1x_, k1v_, kx_, kv_, rx_, rv_;
  SolveStatus status_ = SolveStatus::ok;
};

}  // namespace dartboard
