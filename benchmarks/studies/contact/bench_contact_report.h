#pragma once
// The report of `dartboard bench contact`: tables and claims.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/contact/contact_costs.h"
#include "benchmarks/studies/contact/contact_factors.h"

namespace dartboard {

/// The measured times, and the counts of each situation.
struct ContactCosts {
  std::vector<Sample> samples;
  std::map<std::string, ContactCounts> counts;
  std::size_t largest = 0;  // tetrahedra of the largest plates
  int steps = 1;            // in each sample of steps
  std::vector<ContactFactors> factors{};

  /// The exponent of the growth with the number of tetrahedra, fitted in each process.
  Figure exponent(const std::string& task) const;
  /// The exponent of n log n, fitted at the same numbers.
  double exponent_of_n_log_n() const;
  /// Processor time of one evaluation [ns].
  double evaluation_ns(const std::string& situation, const std::string& task) const;
};

/// Targets of our own. Where the contacts found are wrong, times are not judged.
std::vector<Claim> claims_of(const ContactCosts& costs);

Table contact_steps_table(const ContactCosts& costs);
Table contact_forces_table(const ContactCosts& costs);
Table sleep_table(const ContactCosts& costs);
Table factors_table(const ContactCosts& costs);
/// The basis of the figures.
std::string contact_costs_note();

}  // namespace dartboard
