#pragma once
// The Stormer-Verlet method in its position form: half a drift, a kick, half a drift.

#include "core/time/explicit/frozen_damping.h"
#include "core/time/method/trial_state.h"

namespace dartboard {

/// Order 2, symplectic, one force evaluation; with damping still of order 2 and symmetric.
///
/// The velocity form (kick, drift, kick) is the same map half a step later. It must keep its last force for the next
/// step, which is wrong as soon as the body is moved or cut in between; this form keeps nothing.
/// Damping acts in the middle of the kick, where positions and the directions of the springs are constant, by a
/// symmetric sweep over the springs. Evaluated at an old velocity instead it would reduce the method to order 1.
class Verlet : public Integrator {
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
