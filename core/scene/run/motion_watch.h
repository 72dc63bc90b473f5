#pragma once
// Whether a motion is still valid, step by step, and the way back to its last good state.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/time/method/integrator.h"
#include "core/time/watch/divergence.h"

namespace dartboard {

/// Is every vertex certainly slower? Decided by the sum of the squares; false if a velocity is NaN.
bool all_slower(std::span<const Eigen::Vector3d> velocity, double speed);

/// A quantity of a vertex that is no longer valid.
struct Fault {
  std::string quantity;
  std::uint32_t vertex = 0;
  double value = 0.0;
};

/// A motion has diverged when a position or velocity is not finite (integrators see to that), when a vertex moves
/// faster than light, or when there is more energy than anything in the scene can supply (DivergenceDetector). Both are
/// checked at least in every sixteenth step, in the first and in the last.
class MotionWatch {
 public:
  /// A run starts here, with steps of h [s].
  void start(const SpringSystem& system, Motion motion, double h) { before_ = detector_.start(system, motion, h); }
  /// The body was changed by something else than a step.
  void system_changed(const SpringSystem& system, Motion motion) { before_ = detector_.system_changed(system, motion); }
  /// The detector's result for the state at the start, or after the last change.
  const StepResult& before() const { return before_; }
  /// What is wrong with that state.
  std::optional<Fault> fault_before(const SpringSystem& system, Motion motion) const;

  /// The system has been changed within a step, between two of its parts.
  StepResult changed_within_step(const SpringSystem& system, Motion motion) {
    return detector_.system_changed(system, motion);
  }
  /// The state kept last is not one after n steps, but later by a time [s], within the next step.
  void keeps_within_step(std::uint64_t n, double later) { within_ = {n, later}; }
  /// Judge the state after step n, of which the integrator has reported `result`.
  ///
  /// `work` [J] is done on the body by something that is not in its system. At the last step all springs are summed.
  std::optional<Fault> after_step(StepResult result, std::uint64_t n, bool is_last, double work,
                                  const SpringSystem& system, Motion motion);

  /// Go back to the state kept last: that of the start, that after the last change, or a later one whose energy could
  /// be explained. A step that the integrator could not take has not been checked.
  ///
  struct KeptState {
    std::uint64_t steps_before;  // step n
    double later;                // [s] than the end of that step
  };
  KeptState go_back(std::uint64_t n, Motion motion) const {
    const std::uint64_t before = n - checked_ + detector_.restore(motion);
    return {before, n - before == within_.step ? within_.later : 0.0};
  }

  /// Is the state kept last the present one?
  bool has_just_kept() const { return detector_.has_just_kept(); }

  std::size_t bytes() const { return detector_.bytes(); }
  std::size_t driven_bytes() const { return detector_.driven_bytes(); }

  /// Writes or reads all but the result for the present state, which is found again: `resume` follows.
  template <class Archive>
  void state(Archive& archive) {
    bool is_valid = before_.ok();
    archive(checked_, detector_, is_valid, within_.step, within_.later);
    if (archive.reads()) before_.code = is_valid ? StepCode::ok : StepCode::nonfinite;
  }
  /// An invalid state is found again by its check, which then changes nothing.
  void resume(const SpringSystem& system, Motion motion) {
    if (!before_.ok()) system_changed(system, motion);
  }

 private:
  Fault fault_of(const StepResult& result, const SpringSystem& system, Motion motion) const;

  DivergenceDetector detector_;
  StepResult before_;
  std::uint64_t checked_ = 0;  // the last step that the detector has checked
  struct {
    std::uint64_t step = 0;
    double later = 0.0;  // [s]
  } within_;             // the last step within which a state was kept
};

}  // namespace dartboard
