#pragma once
// Evidence from the steps of a run on its integrator: each is compared with the scheme's from the same state.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/time/system/spring_system.h"
#include "reference/schemes/step_judge.h"

namespace dartboard {

/// The elements of a system; null where the witnesses do not know its force terms.
using KnownElements = const std::vector<reference::ElasticPoint>*;

/// The system, whose force terms are those of `elements`, as a network of the witnesses; nothing if they do not support
/// it: viscosities that are not in proportion to masses, axes that are held, terms unknown to them, free vertices
/// without mass, numbers that are not finite.
std::optional<reference::SpringNetwork> network_of(const SpringSystem& system, KnownElements elements = nullptr);

/// The steps of a run that are judged.
struct JudgedSteps {
  std::uint64_t first = 8;   // all of the first ones
  std::uint64_t most = 200;  // of the others about so many
};

/// Judges the steps of a run: the first ones, and a sample of all others.
class StepEvidence {
 public:
  /// For a run of so many steps.
  /// pre  the elements outlive this
  StepEvidence(std::string_view integrator, std::uint64_t steps, KnownElements elements = nullptr,
               JudgedSteps judged = {});

  /// To be called before and after every step; `restarted` after a restart of the integrator or a change of the system.
  void before(const SpringSystem& system, Motion motion, double h);
  void after(Motion motion);
  void restarted();
  /// Restarted with other elements than before.
  void changed_to(KnownElements elements) {
    elements_ = elements;
    restarted();
  }

  std::uint64_t judged() const { return judged_; }
  /// The number of these steps at which a wrong one would have been seen.
  std::uint64_t seeing() const { return seeing_; }
  /// The largest distance from the scheme's step over its bound, and the step of it.
  double worst() const { return worst_; }
  std::uint64_t worst_step() const { return worst_step_; }
  /// Processor time spent on it [s].
  double seconds() const { return seconds_; }

 private:
  std::string scheme_;
  KnownElements elements_;
  std::uint64_t first_, stride_, count_ = 0, judged_ = 0, seeing_ = 0, worst_step_ = 0;
  bool asks_ = false;  // the present step is judged
  bool changed_ = true;
  double worst_ = 0.0, seconds_ = 0.0;
  std::unique_ptr<const reference::StepJudge> judge_;  // null if the system has none
  reference::TakenStep step_;
};

}  // namespace dartboard
