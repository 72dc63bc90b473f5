#pragma once
// The report of `dartboard bench operations`: tables and claims.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/operations/operation_study.h"

namespace dartboard {

/// The measured times.
struct OperationFigures {
  std::map<std::string, std::vector<OperationSample>> operations;  // by "BODY:OPERATION"
  std::map<std::string, std::vector<BodySample>> bodies;

  /// A quantile of the whole time of an operation [us], or of its first phases, in each process.
  std::vector<double> quantiles(const std::string& body, const std::string& operation, double p,
                                std::size_t first_phase = 0, std::size_t phases = 99) const;
};

/// Targets of our own; the last one is the paper's sentence on rebuilding.
/// pre  "liver564" is among the bodies
std::vector<Claim> claims_of(const OperationFigures& figures, const std::vector<std::string>& bodies);

Table operations_table(const OperationFigures& figures, const std::vector<std::string>& bodies);
Table views_table(const OperationFigures& figures, const std::vector<std::string>& bodies);
/// The basis of the figures.
std::string operations_note();

}  // namespace dartboard
