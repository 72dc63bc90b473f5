#pragma once
// The findings of `extremes`: tables, claims, JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/extremes/extremes.h"
#include "validation/stability/amplification_study.h"
#include "validation/stability/detection_study.h"
#include "validation/stability/energy_rounding.h"
#include "validation/stability/stability_limits.h"
#include "validation/stability/stability_map.h"

namespace dartboard {

/// Parts of studies that were not requested are empty.
struct ExtremesResults {
  std::vector<nlohmann::ordered_json> cells{};  // as child processes deliver them
  std::vector<StabilityLimit> limits{};
  std::vector<MeshBody> meshes{};  // the bodies on which the limits on meshes are based
  std::vector<StabilityMap> maps{};
  std::vector<AmplificationPoint> amplification{};
  std::vector<RoundingGrowth> rounding{};
  std::vector<TinySteps> tiny{};
  std::vector<Detection> detections{};
};

nlohmann::ordered_json to_json(const ExtremeCell& cell);
nlohmann::ordered_json to_json(const ExtremesResults& results);

/// SILENT and CRASH.
std::vector<nlohmann::ordered_json> forbidden_cells(const ExtremesResults& results);

/// Diagnosed cells whose diagnosis names no quantity (`names_a_quantity`).
std::vector<nlohmann::ordered_json> nameless_cells(const ExtremesResults& results);

/// Targets of our own, for the studies that were made.
std::vector<Claim> claims_of(const ExtremesResults& results);

/// For the studies that were made.
std::vector<NamedTable> tables_of(const ExtremesResults& results);

}  // namespace dartboard
