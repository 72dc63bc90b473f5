#pragma once
// The stable region of an integrator, over steps and damping ratios, measured by runs.

#include <vector>

#include "core/time/integrators.h"

namespace dartboard {

/// A map over (h omega, damping ratio) of the growth of an oscillation, and the boundary in it.
struct StabilityMap {
  std::string integrator;
  std::vector<double> theta, zeta;  // of the map; the first ratio is 0, the others ascend by equal factors
  std::vector<double> growth;       // ln of the growth factor of the oscillation in a step, a row per ratio

  /// A place where a run of this length begins or ceases to grow by the gain, by theory and by measurement.
  struct Crossing {
    double zeta, theory;
    double measured = 0.0;  // 0 if there is none within 1 % of the theory
    double distance() const { return std::abs(measured / theory - 1.0); }
  };
  std::vector<Crossing> boundary;
  double worst() const;  // distance; NaN where one is

  struct Point {
    double theta, zeta;
  };
  std::vector<Point> theory;  // the boundary, in points close enough for a line
};

struct MapPlan {
  double theta_most = 4.0, zeta_least = 1e-3, zeta_most = 10.0;
  int columns = 160, rows = 60;
  int boundary_rows = 25;      // on which runs search for the boundary, the first at 0
  std::uint64_t steps = 3000;  // of such a run
};
MapPlan map_plan(const Scheme& scheme, bool quick);

/// Runs of an explicit integrator on a mass on a spring at a wall.
StabilityMap measure_stability_map(const IntegratorEntry& entry, const MapPlan& plan);

}  // namespace dartboard
