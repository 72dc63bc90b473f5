#pragma once
// The work-precision diagram of a scene.

#include "benchmarks/figures/plot.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// Error against cost: the front bold, what is dominated faded, runs that failed at the upper border with their
/// diagnosis, what the reference cannot tell hollow.
///
/// A run that failed stands where it would have ended: at the cost of the next run of that method that did not,
/// by the ratio of their steps.
Plot work_precision_plot(const WorkPrecision& study);

}  // namespace dartboard
