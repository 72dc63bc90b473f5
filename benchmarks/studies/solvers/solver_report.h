#pragma once
// The report of `dartboard validate solvers`: tables, claims and raw samples.

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/solvers/solver_timing.h"
#include "validation/solvers/crossover.h"
#include "validation/solvers/factor_edits.h"
#include "validation/solvers/solver_accuracy.h"

namespace dartboard {

/// The measurements; parts that were not requested are empty.
struct SolverResults {
  std::vector<SolveCell> cells;
  std::vector<IndefiniteCell> indefinite;
  std::vector<EditRun> edits;
  std::vector<SolverTimes> updates, steps;
  std::vector<Crossover> crossovers;
  double crossover_error = 0.0;  // [edges]
};

/// All cells of one path: the largest errors, and the diagnoses.
struct PathSummary {
  std::size_t solved = 0, diagnosed = 0, updated = 0;
  double before = 0.0, normwise = 0.0, after = 0.0;
  std::map<std::string, std::size_t> diagnoses;
};
PathSummary summary_of(std::span<const SolveCell> cells, SolvePath path);

std::vector<Claim> claims_of(const SolverResults& results);

std::vector<NamedTable> tables_of(const SolverResults& results);

/// Each sample as one JSON object.
void for_each_sample(const SolverResults& results, const std::function<void(const nlohmann::json&)>& sink);

/// T omega_max at which both sides cost the same, predicted and measured, against the size of the body.
/// pre     there is a crossover that was found
Plot crossover_plot(std::span<const Crossover> crossovers);

}  // namespace dartboard
