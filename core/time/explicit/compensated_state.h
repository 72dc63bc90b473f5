#pragma once
// A motion that keeps the digits which rounding takes from it, for steps that change its last digits only.

#include <span>
#include <vector>

#include "core/time/method/trial_state.h"

namespace dartboard {

/// x and v as unevaluated sums of two doubles: the visible value, and the part that did not fit into it, half a unit in
/// the last place at most.
///
/// Additions are exact except for the rounding of the increments themselves (Knuth's two-sum), so that 10^6 steps that
/// each move a vertex by less than a unit in the last place still move it. Forces use the visible value only.
/// source  Hairer, McLachlan, Razakarivony: Achieving Brouwer's law with implicit Runge-Kutta methods, 2008
class CompensatedState {
 public:
  /// Begin a step from a motion. The lost digits of a coordinate are those of the last commit where it has not changed
  /// since, and zero where it has.
  void begin(Motion motion);

  std::span<const Eigen::Vector3d> x() const { return end_.x; }
  std::span<const Eigen::Vector3d> v() const { return end_.v; }

  /// x += t v.
  void drift(double t);
  /// v += t a.
  void kick(double t, std::span<const Eigen::Vector3d> a);

  /// As TrialState::commit; a step that fails loses no digits either.
  StepResult commit(Motion motion, WorkCounters& work);

  /// The digits lost so far, by vertex; to be added to the visible values.
  const TrialState& lost() const { return lost_; }
  template <class Archive>
  void state(Archive& archive) {
    archive(lost_, left_);
  }
  std::size_t bytes() const { return end_.bytes() + lost_.bytes() + lost_at_end_.bytes() + left_.bytes(); }

 private:
  TrialState end_, lost_, lost_at_end_, left_;
};

}  // namespace dartboard
