#pragma once
// The report of `dartboard tradeoff --models`: claims, tables, a sentence and a picture.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/figures/panels.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/models/models_results.h"

namespace dartboard {

std::vector<Claim> claims_of(const ModelsResults& results);

/// A row for each point.
Table points_table(const ModelsResults& results);
/// A row for each question and ratio: which model is the cheapest for which errors.
Table reigns_table(const ModelsResults& results);
Table truths_table(const ModelsResults& results);

/// The cheapest model above and below each error.
std::string in_words(const ModelsResults& results);

/// Error against processor time per simulated second: a row of panels for each ratio, a panel for each question.
Panels models_panels(const ModelsResults& results);

nlohmann::ordered_json json_of(const ModelsResults& results);
nlohmann::json json_of(const ModelPoint& point);

}  // namespace dartboard
