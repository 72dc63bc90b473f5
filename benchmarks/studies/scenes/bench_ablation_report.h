#pragma once
// The report of `dartboard bench ablation`: tables, claims and a picture.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// Bytes of the objects of a variant.
struct AblationBytes {
  std::size_t total = 0, tetrahedra = 0, springs = 0;
  std::size_t not_asked_for = 0;  // of parts that a bare scene does not need
  std::size_t damping = 0;        // of springs, beyond rest length, stiffness and ends
  double per_tetrahedron() const { return static_cast<double>(total) / static_cast<double>(tetrahedra); }
};

/// The measured times and bytes.
struct AblationFigures {
  std::vector<Sample> samples;
  std::map<std::string, AblationBytes> bytes;
  int steps = 1;  // in each sample

  double step_us(const std::string& task) const { return times_of(samples, task).cpu_median / steps / 1e3; }
};

std::vector<Claim> claims_of(const AblationFigures& figures);

Table features_table(const AblationFigures& figures);
Table staircase_table(const AblationFigures& figures);
/// A scene with all that it writes, and the least that this could take.
Table output_table(const AblationFigures& figures);
/// The basis of the figures.
std::string features_note();

/// A row for each feature, with its time along the axis and its bytes as text.
Plot ablation_plot(const AblationFigures& figures);

}  // namespace dartboard
