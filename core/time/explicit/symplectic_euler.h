#pragma once
// The symplectic Euler method, which the graphics literature calls semi-implicit.

#include "core/time/explicit/frozen_damping.h"
#include "core/time/method/trial_state.h"

namespace dartboard {

/// v += h a(x), damping by its flow at x, x += h v.
///
/// Started at rest its velocities look like those of a method of order 2; its positions do not.
class SymplecticEuler : public Integrator {
 public:
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override;
  std::size_t bytes() const override { return end_.bytes() + bytes_of(a_) + damping_.bytes() + terms_.bytes(); }

 private:
  KnownTerms terms_;
  FrozenDamping damping_;
  TrialState end_;
  std::vector<Eigen::Vector3d> a_;
};

}  // namespace dartboard
