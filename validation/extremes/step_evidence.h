#pragma once
// What the steps of a run say about its integrator: each beside what the scheme gives from the same state.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/time/system/spring_system.h"
#include "reference/schemes/step_judge.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard {

/// The system, its other terms being those of `solid`, as a network of the witnesses'; nothing where they know no such
/// bodies: viscosities that are not in proportion to masses, forces from outside, terms that they are not told of, free
/// vertices without mass, numbers that are not finite.
std::optional<reference::SpringNetwork> network_of(const SpringSystem& system, const ElasticSolid* solid = nullptr);

/// Judges the steps of a run: the first ones, and a sample of all others.
class StepEvidence {
 public:
  /// of a run of so many steps, of which about `most` are judged; of springs, and of a solid that outlives this
  StepEvidence(std::string_view integrator, std::uint64_t steps, const ElasticSolid* solid = nullptr,
               std::uint64_t most = 200);

  /// To be called before and after every step; `restarted` where the integrator was, or the system has changed.
  void before(const SpringSystem& system, Motion motion, double h);
  void after(Motion motion);
  void restarted();

  std::uint64_t judged() const { return judged_; }
  /// Of these, steps at which a wrong one would have been seen.
  std::uint64_t seeing() const { return seeing_; }
  /// The largest distance from the scheme's step over its bound, and in which step.
  double worst() const { return worst_; }
  std::uint64_t worst_step() const { return worst_step_; }
  /// Processor time spent on it [s].
  double seconds() const { return seconds_; }

 private:
  std::string scheme_;
  const ElasticSolid* solid_;
  std::uint64_t stride_, count_ = 0, judged_ = 0, seeing_ = 0, worst_step_ = 0;
  bool asks_ = false;  // whether the step under way is judged
  bool changed_ = true;
  double worst_ = 0.0, seconds_ = 0.0;
  std::unique_ptr<const reference::StepJudge> judge_;  // null where there is none for the system
  reference::TakenStep step_;
};

}  // namespace dartboard
