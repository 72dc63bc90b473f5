#pragma once
// The verdict of `dartboard validate topology` on a mesh.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/table.h"
#include "validation/topology/topology_fuzz.h"
#include "validation/topology/topology_report.h"

namespace dartboard {

/// One series of random operations.
struct FuzzSeries {
  ScriptStorage storage;
  ScriptOracles oracles;
  std::uint64_t seed;
  FuzzResult result;
  double operations_per_s = 0.0;
};

/// All results on one mesh.
struct TopologyVerdict {
  std::string name;
  std::size_t darts = 0;
  TopologyComparison at_rest;
  std::vector<FuzzSeries> sessions;
  std::string script_file;  // of the disagreement, if there is one

  bool agrees() const {
    return at_rest.agrees() && std::none_of(sessions.begin(), sessions.end(),
                                            [](const FuzzSeries& s) { return s.result.disagreement.has_value(); });
  }
};

/// The questions at rest, and what each carrier answers.
Table rest_table(const TopologyComparison& comparison);

/// A row for each mesh.
Table summary_table(const std::vector<TopologyVerdict>& verdicts);

nlohmann::ordered_json to_json(const Disagreement& disagreement);
nlohmann::ordered_json to_json(const TopologyVerdict& verdict);

/// The differences, at rest and during the operations, with the script and the command that replays it; empty if none.
std::string disagreements_text(const TopologyVerdict& verdict);

}  // namespace dartboard
