#pragma once
// The time until an unstable run is found: predicted before it, and detected after its energy has passed the bound.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/time/integrators.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// A run with a step beyond the limit.
struct Detection {
  std::string body{}, integrator{};
  double factor = 0.0;  // step over the longest stable one, for a long run
  bool predicted = false;
  std::uint64_t steps = 0;                // made
  std::uint64_t above = 0;                // the most steps in a row that ended with more energy than that
  std::optional<std::uint64_t> passed{};  // the first step after which the energy exceeds what the detector allows
  std::optional<std::uint64_t>
      detected{};  // the step after which the run was ended, by the detector or the step itself

  /// Predicted, and ended before the energy has been above the bound for more than 64 steps in a row.
  bool holds() const { return predicted && above <= 64; }
};

/// Steps over the longest stable one, ascending.
std::vector<double> detection_factors(bool quick);

/// Steps of 1.0001 to 1e8 times the limit, every explicit integrator with a limit, four bodies, from a motion in all
/// modes and from one in the fastest, up to 5000 steps. The energy is summed here after every step, in extended
/// precision.
///
/// Close to the limit it takes ln(gain / share of the unstable modes) / ln(growth per step) steps to pass the bound,
/// and large motions may soften a body so that it never does; no bound on energy can be passed sooner, and a lower
/// bound would stop stable runs.
std::vector<Detection> measure_detection(bool quick);

/// One of these runs, in steps of h [s]; `factor` is h over the limit.
Detection watch_for_divergence(const IntegratorEntry& entry, SpringColumns body, double h, double factor);

}  // namespace dartboard
