#pragma once
// Two runs of scenes, compared: the keys that differ, where and when their bodies part, and by how much.

#include "benchmarks/report/report.h"
#include "benchmarks/studies/compare/compare_study.h"

namespace dartboard {

/// Compare two runs of `simulate --out`. They differ where a vertex is more than `plan.within` edge lengths off, or
/// their cells part.
///
/// throws  IoError where a file is missing or damaged
Report compare_runs(const ComparePlan& plan);

/// As `compare_runs` or `compare_study`, by what the folders hold.
///
/// throws  InputError for one of each
Report compare(const ComparePlan& plan);

}  // namespace dartboard
