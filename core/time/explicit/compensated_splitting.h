#pragma once
// Verlet's and Blanes and Moan's methods on a state that loses no digits.

#include <memory>
#include <vector>

#include "core/time/explicit/compensated_state.h"
#include "core/time/explicit/frozen_damping.h"
#include "core/time/method/splitting.h"

namespace dartboard {

/// A splitting method whose drifts and kicks are added without loss.
///
/// For steps so short that they change the last digits of positions only, and for runs so long that rounding shows. A
/// restart keeps the lost digits, since they belong to the motion. With damping, kicks are those of BlanesMoan4:
/// increments, which flows taken spring by spring are not.
/// cost  as the plain method, and some ten additions per vertex, drift and kick
class CompensatedSplitting : public Integrator {
 public:
  CompensatedSplitting(const Scheme& scheme, const Splitting& splitting) : scheme_(scheme), splitting_(splitting) {}

  const Scheme& scheme() const override { return scheme_; }
  StepResult step(const SpringSystem& system, Motion motion, double h) override;
  void restart() override { terms_.forget(); }
  void state(Archive& archive) override {
    Integrator::state(archive);
    archive(state_);
  }
  std::size_t bytes() const override {
    return state_.bytes() + bytes_of(a_, product_, sum_) + damping_.bytes() + terms_.bytes();
  }

  /// The digits that the motion lacks, by vertex.
  const TrialState& lost() const { return state_.lost(); }

 private:
  void damped_kick(const SpringSystem& system, const Terms& terms, double t);

  const Scheme& scheme_;
  const Splitting& splitting_;
  KnownTerms terms_;
  FrozenDamping damping_;
  CompensatedState state_;
  std::vector<Eigen::Vector3d> a_, product_, sum_;
};

std::unique_ptr<Integrator> make_compensated_verlet();
std::unique_ptr<Integrator> make_compensated_blanes_moan_4();

}  // namespace dartboard
