#pragma once
// The tables of `dartboard tradeoff` on a scene.

#include <string>
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

/// What costs, errors and regrets are.
std::string reading_of_costs();

}  // namespace dartboard
