#pragma once
// Unseen scenes: bodies, materials, motions and cuts drawn from a seed.

#include <cstdint>

#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

struct RandomSceneOptions {
  int least_points = 100;
  int most_points = 3000;      // of the body, about
  double most_work = 4e5;      // springs times duration times omega_max: the cost of a reference
  double least_work = 0.0;     // the least cost of a run
  double damped_work = 1.0;    // factor of both for a damped scene, whose runs take longer steps
  double least_phase = 30.0;   // duration times omega_max
  double most_phase = 400.0;   // the same, as far as the work allows
  double least_strain = 0.01;  // at the start
  double most_strain = 0.1;    // at this strain undamped bodies are chaotic after some hundred periods
  double least_sag = 0.02;     // [edges] about how far gravity moves a body
  double most_sag = 0.2;
  bool cuts = true;  // may a plane cut it?
};

/// Scene `number` of a seed; it does not depend on the others.
///
/// A jittered box or a Delaunay ball; free, or clamped on one side; with or without gravity;
/// damping ratios at omega_max of 0, 0.001 to 0.1, or 0.3 to 1.5; a tenth of the cells 1 to 10^4 times as stiff, or a
/// cut by a plane, or neither; stretched, sheared and turning at the start. `what` says which.
TradeoffScene random_scene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options = {});

}  // namespace dartboard
