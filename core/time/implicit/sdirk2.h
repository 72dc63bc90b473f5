#pragma once
// The singly diagonally implicit Runge-Kutta method of two stages and order 2.

#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

/// Two stages with the same tau = gamma h, gamma = 1 - 1/sqrt(2), so that one factor serves both; the second is the
/// result.
///
/// order   2; L-stable
/// source  Alexander 1977
class Sdirk2 : public ImplicitIntegrator {
 public:
  explicit Sdirk2(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  std::size_t bytes() const override {
    return ImplicitIntegrator::bytes() + start_.bytes() + bytes_of(slope_x_, slope_v_);
  }

 private:
  TrialState start_;                                // of the second stage
  std::vector<Eigen::Vector3d> slope_x_, slope_v_;  // of the first stage
};

}  // namespace dartboard
