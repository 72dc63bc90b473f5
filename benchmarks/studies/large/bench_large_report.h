#pragma once
// The report of `dartboard bench large`: tables, claims and a figure.

#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/large/large_bodies.h"

namespace dartboard {

/// The bodies measured, by the cubes along an edge, ascending.
std::vector<std::size_t> large_sides(bool quick);
/// The body of two million tetrahedra, whose start has a target, and that of ten, which is run once.
inline constexpr std::size_t started_side = 70, largest_side = 119;

/// The measured times and counts.
struct LargeFigures {
  std::vector<std::size_t> sides;
  std::vector<LargeTime> times;
  std::vector<LargeCounts> counts;

  bool has(std::size_t side, const char* part) const;
  /// [s] Median and interval over processes.
  /// pre  has(side, part)
  Figure seconds(std::size_t side, const char* part) const;
  /// These seconds over the limit.
  /// pre  has(side, part), and it has a limit
  Figure over_limit(std::size_t side, const char* part) const;
};

/// Targets of our own.
std::vector<Claim> claims_of(const LargeFigures& figures);

Table parts_table(const LargeFigures& figures);
Table memory_table(const LargeFigures& figures);
/// The basis of the figures.
std::string large_note();
Plot large_plot(const LargeFigures& figures);

}  // namespace dartboard
