#pragma once
// What `dartboard bench ablation` says: tables, claims and a picture.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// What the objects of a variant take.
struct AblationBytes {
  std::size_t total = 0, tetrahedra = 0, springs = 0;
  std::size_t not_asked_for = 0;  // of parts that a bare scene does not need
  std::size_t damping = 0;        // of springs, beyond rest length, stiffness and ends
  double per_tetrahedron() const { return static_cast<double>(total) / static_cast<double>(tetrahedra); }
};

/// What was measured.
struct AblationFigures {
  std::vector<Sample> samples;
  std::map<std::string, AblationBytes> bytes;
  int steps = 1;  // that a sample is the time of

  double step_us(const std::string& task) const { return times_of(samples, task).cpu_median / steps / 1e3; }
};

std::vector<Claim> claims_of(const AblationFigures& figures);

Table features_table(const AblationFigures& figures);
Table staircase_table(const AblationFigures& figures);
/// What the figures rest on.
std::string features_note();

/// A row for each feature, its time along it, its bytes beside it.
Plot ablation_plot(const AblationFigures& figures);

}  // namespace dartboard
