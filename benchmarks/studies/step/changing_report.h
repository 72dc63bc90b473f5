#pragma once
// The conclusions on bodies that change in every step.

#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/step/changing_bodies.h"

namespace dartboard {

struct ChangingCosts {
  std::vector<ChangingCounts> bodies;
  std::vector<Sample> samples;

  /// One task over another (changing_task).
  Figure over(const std::string& body, const char* task, const char* baseline) const;
  /// What differed before the bodies were timed, and rounds in which a task with dissociations did not leave the
  /// same bits.
  std::size_t count_differing() const;
};

/// Targets of our own, and a ratio that has none. Not judged where bodies differ.
std::vector<Claim> claims_of(const ChangingCosts& costs);
Table changing_table(const ChangingCosts& costs);
std::string changing_note();

}  // namespace dartboard
