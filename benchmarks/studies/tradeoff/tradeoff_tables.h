#pragma once
// The text of `dartboard tradeoff` on a scene: tables, and the page that holds them.

#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/table.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// The errors of the tables: 0.1, 0.01, ... down to the floor of the reference.
std::vector<double> decades(const WorkPrecision& study);

/// For each error the cheapest method, and how much more the next one and CVODE cost.
Table winners_table(const WorkPrecision& study);
/// The cost of each method relative to the cheapest, a column for each error.
Table regrets_table(const WorkPrecision& study);
/// All runs.
Table points_table(const WorkPrecision& study);

/// A list of lines, each escaped for its place.
std::string bullets(const std::vector<std::string>& lines, std::string (*escaped)(std::string_view));

/// The page of a scene in Markdown, which shows the picture "`stem`.svg" in the same folder.
std::string tradeoff_page(const WorkPrecision& study, const std::string& stem);

}  // namespace dartboard
