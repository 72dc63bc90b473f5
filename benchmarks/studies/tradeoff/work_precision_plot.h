#pragma once
// The work-precision diagram of a scene.

#include "benchmarks/figures/plot.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// Error against cost: the front bold, dominated runs faded, runs that failed at the upper border with their diagnosis,
/// errors below the floor of the reference hollow.
///
/// A failed run is drawn where it would have ended: at the cost of the next run of that method that did not fail,
/// scaled by the ratio of their steps.
Plot work_precision_plot(const WorkPrecision& study);

}  // namespace dartboard
