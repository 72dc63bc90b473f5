#pragma once
// The conclusions on steps of bodies that have changed.

#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/step/changed_bodies.h"

namespace dartboard {

struct ChangedCosts {
  std::vector<ChangedCase> cases;
  std::vector<Sample> samples;

  /// A step of the changed body over one of the fresh body.
  Figure over_fresh(const ChangedCase& one) const;
  /// Of a spring and evaluation [ns].
  double spring_ns(const ChangedCase& one, const char* task) const;
  std::size_t count_differing() const;
};

/// A target of our own for boxes of 10^5 and of 10^6 tetrahedra, each met by every change. Not judged where bodies
/// differ.
std::vector<Claim> claims_of(const ChangedCosts& costs);
Table changed_table(const ChangedCosts& costs);
std::string changed_note();

}  // namespace dartboard
