#pragma once
// Output of `dartboard tradeoff` for other programs; numbers that are not finite are null.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// One run, a line of samples.jsonl.
nlohmann::json json_of(const std::string& scene, const WorkPoint& point);

/// The cheapest methods of a scene, an entry of winners.json.
nlohmann::json summary_of(const WorkPrecision& study);

}  // namespace dartboard
