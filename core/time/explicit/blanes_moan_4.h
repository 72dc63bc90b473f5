#pragma once
// The six-stage symmetric splitting of order 4 by Blanes and Moan: seven drifts around six kicks.

#include "core/time/explicit/frozen_damping.h"
#include "core/time/method/trial_state.h"

namespace dartboard {

/// Order 4, symplectic, six force evaluations, with error constants far below those of other compositions.
///
/// With damping the kicks become flows of v' = a(x) - B v at fixed x, so it is still a splitting into two parts, and of
/// order 4. That flow is v + t (1 - z/2 + z^2/6 - z^3/24) (a - B v) with z = t B, four products with B: their error is
/// of order t^5, they conserve both momenta, and no flow is taken spring by spring, which would be of order 2. Some of
/// the t are negative (0.14 h): damping then amplifies for a moment, which is harmless as long as h B is moderate; the
/// amplification shows how far that goes. Without damping the purely symplectic scheme runs.
class BlanesMoan4 : public Integrator {
 public:
  const Scheme& scheme() const override;
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override { terms_.forget(); }
  std::size_t bytes() const override {
    return end_.bytes() + bytes_of(a_, product_) + damping_.bytes() + terms_.bytes();
  }

 private:
  void damped_kick(const SpringSystem& system, const Terms& terms, double t);

  KnownTerms terms_;
  FrozenDamping damping_;
  TrialState end_;
  std::vector<Eigen::Vector3d> a_, product_;
};

}  // namespace dartboard
