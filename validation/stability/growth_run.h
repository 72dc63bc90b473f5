#pragma once
// Does a small oscillation grow under an integrator? The measurement behind all results on stability.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/time/method/integrator.h"
#include "validation/scenes/extreme_bodies.h"

namespace dartboard {

/// An oscillation about rest, and how long it is watched.
struct GrowthRun {
  static constexpr std::uint64_t window = 64;  // steps over which the size of the oscillation is measured

  double omega = 0.0;                  // [1/s]
  std::vector<Eigen::Vector3d> shape;  // [edges], the largest coordinate about 1; starts at 1e-8 of it
  std::uint64_t steps = 10000;
  double gain = 1e3;

  /// The steps over which growth is measured: from the end of the first tenth to the last window.
  double measured_steps() const { return static_cast<double>(steps - steps / 10 - window); }
};

/// Whether the oscillation grows by less than `gain`; a run stops far beyond it, where motion ceases to be linear.
bool is_stable(const GrowthRun& run, const SpringColumns& at_rest, Integrator& integrator, double h);

}  // namespace dartboard
