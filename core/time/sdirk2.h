#pragma once
// The singly diagonally implicit Runge-Kutta method of two stages and order 2.

#include "core/time/implicit_integrator.h"

namespace dartboard {

/// Two stages with the same tau = gamma h, gamma = 1 - 1/sqrt(2), so that one factor serves both; the second is the
/// result.
///
/// order   2, an embedded one of order 1 estimates the error; L-stable
/// source  Alexander 1977; the embedded weights of Ellsiepen 1999
class Sdirk2 : public ImplicitIntegrator {
 public:
  explicit Sdirk2(const ImplicitOptions& options = {}) : ImplicitIntegrator(options) {}

  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  std::size_t bytes() const override {
    return ImplicitIntegrator::bytes() + start_.bytes() + error_.bytes() + bytes_of(slope_x_, slope_v_);
  }

  /// The estimated error of the last step that was taken: the difference from the embedded result.
  std::span<const Eigen::Vector3d> position_error() const { return error_.x; }
  std::span<const Eigen::Vector3d> velocity_error() const { return error_.v; }

 private:
  TrialState start_, error_;                        // of the second stage; of the step
  std::vector<Eigen::Vector3d> slope_x_, slope_v_;  // of the first stage
};

}  // namespace dartboard
