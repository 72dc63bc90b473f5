#pragma once
// Unseen scenes: bodies, materials, motions, loads, contacts and events drawn from a seed, as files of scenes.

#include <cstdint>
#include <nlohmann/json.hpp>

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
  double least_strain = 0.01;  // that the motion at the start leads to
  double most_strain = 0.1;    // at this strain undamped bodies are chaotic after some hundred periods
  double least_sag = 0.02;     // [edges] about how far gravity moves a body
  double most_sag = 0.2;
  bool only_springs = false;  // no elements, loads, contact and events: what other codes can follow
};

/// Scene `number` of a seed, as a user would write it; it does not depend on the others.
///
/// A jittered box, a ball, a sheet, or a box of hexahedra; springs or elements; free, or one side clamped or driven to
/// and fro; gravity, a force for some time, or a floor; damping ratios at omega_max of 0, 0.001 to 0.1, or 0.3 to 1.5;
/// cells that are up to 10^4 times as stiff, cuts, removals, or tears under stress; stretched, sheared and turning at
/// the start. `about` says which.
nlohmann::ordered_json random_scene_file(std::uint64_t seed, std::uint64_t number,
                                         const RandomSceneOptions& options = {});
/// The scene of that file, read.
TradeoffScene random_scene(std::uint64_t seed, std::uint64_t number, const RandomSceneOptions& options = {});

}  // namespace dartboard
