#pragma once
// The report of `dartboard extremes SCENE...`: a table of outcomes by integrator and step for each scene, and claims.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"

namespace dartboard {

/// The runs of one scene, as child processes deliver them.
struct SceneCells {
  std::string name;
  std::string beyond_references;  // the part that the witnesses do not support; empty where they do
  std::string failure{};          // the reason why nothing was run; empty where it was
  std::vector<nlohmann::ordered_json> cells{};
};

/// One for each scene: it falls short where a run is SILENT or ends the process, and is undecided where runs are judged
/// by their survival alone.
std::vector<Claim> claims_of(const std::vector<SceneCells>& scenes);

/// A row for each integrator and a column for each step, the outcome in each place, with the step where a run stopped.
std::vector<NamedTable> tables_of(const std::vector<SceneCells>& scenes);

}  // namespace dartboard
