#pragma once
// The treatment of a step that is too long to be stable: it is warned of, refused or divided.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/run_end.h"
#include "core/time/method/step_limit.h"

namespace dartboard {

/// A step that is too long to be stable, found before the first step or after an event.
struct StepWarning {
  std::uint64_t step = 0;   // found after this many steps
  double stable = 0.0;      // [s] the longest stable step
  std::uint64_t parts = 1;  // that each step is divided into
  bool by_contact = false;  // contacts of the expected depth limit the step, more than the body does
  template <class Archive>
  void state(Archive& archive) {
    archive(step, stable, parts, by_contact);
  }
};
/// "after 12 steps: a step of 0.01 s is too long for rk4; 0.0031 s is stable"
std::string to_string(const StepWarning& warning, double step, std::string_view integrator);

class StepGuard {
 public:
  StepGuard(const SceneFile& scene, double step);
  /// Contacts are expected to become as deep as a share of the depth of their law.
  void expect_contact(double share) { contact_share_ = share; }

  /// Examine the step for the body as it is after n steps.
  ///
  /// cost  a third of a force evaluation; a hundred if the step is not stable by the quick bound
  void examine(const SimulatedBody& body, const Scheme& scheme, std::uint64_t n);
  /// The limits found then: only a quick bound, if the step is stable by that bound.
  const StableStep& limits() const { return limits_; }
  /// The limits for the body as it is now.
  /// cost  a hundred force evaluations
  StepLimit limit(const SimulatedBody& body, const Scheme& scheme) const;
  const Horizon& horizon() const { return horizon_; }
  /// The first step found to be too long.
  const std::optional<StepWarning>& warning() const { return warning_; }

  /// The refusal of the step after n, by a scene that says so, and of one that would need too many parts.
  std::optional<StepRefusal> refusal(const Scheme& scheme, std::uint64_t n, double time) const;
  /// Each step is taken in so many parts; a piece of it [s] in parts that are no longer, to rounding.
  std::uint64_t parts() const { return parts_; }
  double parts_of(double piece) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(limits_, warning_, parts_, too_long_, stable_, parts_wanted_);
  }

 private:
  StableStep close_limits(const SimulatedBody& body) const;
  double rate_of_contact(const SimulatedBody& body) const;

  double step_;
  UnstableStep treatment_;
  Horizon horizon_;
  double contact_share_ = 0.0;
  StableStep limits_;
  std::optional<StepWarning> warning_;
  std::uint64_t parts_ = 1;
  bool too_long_ = false;
  double stable_ = 0.0;        // [s] the longest stable step, if the step is too long
  double parts_wanted_ = 1.0;  // of a step that is not divided because it would need too many
};

}  // namespace dartboard
