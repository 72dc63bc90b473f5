#pragma once
// The state that a step ends with, before it is known to be finite.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/bytes.h"
#include "core/time/method/integrator.h"
#include "core/time/system/accelerations.h"

namespace dartboard {

/// The first vertex with a position or velocity that is not finite, as a diagnosis; or ok.
StepResult check_finite(std::span<const Eigen::Vector3d> x, std::span<const Eigen::Vector3d> v);

/// Positions and velocities that a step is computed in, so that a step that fails leaves the motion unchanged.
struct TrialState {
  std::vector<Eigen::Vector3d> x, v;

  void resize(std::size_t n) {
    x.resize(n);
    v.resize(n);
  }
  std::size_t bytes() const { return bytes_of(x, v); }
  template <class Archive>
  void state(Archive& archive) {
    archive(x, v);
  }
  /// Copy it into the motion and count a step, or diagnose it and count a failed step.
  StepResult commit(Motion motion, WorkCounters& work) const;
};

/// The terms of a system, looked up at the first step and after `forget`.
class KnownTerms {
 public:
  const Terms& of(const SpringSystem& system) {
    if (!known_) terms_ = terms_of(system);
    known_ = true;
    return terms_;
  }
  void forget() { known_ = false; }
  std::size_t bytes() const { return terms_.shares ? bytes_of_shares(*terms_.shares) : 0; }

 private:
  Terms terms_;
  bool known_ = false;
};

}  // namespace dartboard
