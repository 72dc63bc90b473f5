#pragma once
// The report of `dartboard bench step`: tables, claims and the figure of its limits.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/step/step_costs.h"

namespace dartboard {

/// The measured times, and the counts of each body.
struct StepCosts {
  std::vector<Sample> samples;
  std::map<std::string, StepCounts> counts;
  std::size_t largest = 0;            // tetrahedra of the largest boxes
  std::vector<std::string> meshes{};  // bodies of files, after the others

  /// Those that were counted, in the order of tables.
  std::vector<std::string> bodies() const;

  bool timed(const std::string& body, const char* task) const;
  /// Several threads are compared by the wall clock, others by processor time.
  Figure over(const std::string& body, const char* task, const char* baseline) const;
  /// Of a spring and evaluation [ns].
  double spring_ns(const std::string& body, const char* task) const;
  /// The least time of a spring and evaluation [ns]: of its square root and division, and of its bytes at the speed at
  /// which columns as large are copied.
  double in_core_ns(const std::string& body) const;
  double bandwidth_ns(const std::string& body, const char* task = step_task::copy) const;
  /// [GB/s] read and written, by one thread or by all that share the body.
  double copied_per_second(const std::string& body, const char* task = step_task::copy) const;
  double bytes_of_spring(const std::string& body) const;
  /// Bodies whose columns are left in several states by the ways to step them.
  std::size_t count_bodies_that_differ() const;
};

/// Targets of our own. Where the ways to step a body do not agree, times are not judged.
std::vector<Claim> claims_of(const StepCosts& costs);

Table steps_table(const StepCosts& costs);
Table limits_table(const StepCosts& costs);
/// The basis of the figures.
std::string step_costs_note(const StepCosts& costs);

/// Time of a spring by the size of the body, between its limits.
Plot roofline_plot(const StepCosts& costs);

}  // namespace dartboard
