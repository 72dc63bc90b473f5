#pragma once
// The pictures of `extremes`.

#include <vector>

#include "benchmarks/figures/panels.h"
#include "benchmarks/figures/plot.h"
#include "validation/stability/amplification_study.h"
#include "validation/stability/energy_rounding.h"
#include "validation/stability/stability_map.h"

namespace dartboard {

/// A panel per integrator: measured growth in colours, the boundary of theory as a line, that of runs as circles. The
/// ratio 0 stands below the logarithmic ones.
Panels maps_figure(const std::vector<StabilityMap>& maps);

/// Amplitude, phase and numerical damping over the step, implicit methods above, explicit ones below: theory as lines,
/// measurements as points.
Panels amplification_figure(const std::vector<AmplificationPoint>& points);

/// Energy errors over steps, with a line of slope 1/2.
Plot rounding_figure(const std::vector<RoundingGrowth>& all);

}  // namespace dartboard
