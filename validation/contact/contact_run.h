#pragma once
// Runs of a scene in which bodies touch, inspected by other code on the way.

#include <cstddef>
#include <functional>
#include <string>

#include "core/scene/run/simulation.h"
#include "validation/contact/judged_overlaps.h"

namespace dartboard {

struct ContactRun {
  std::string scene;
  std::size_t looks = 0;
  std::size_t contacts = 0;  // the most at a look
  OverlapTally by_depth{};   // of all looks, in depths that the law allows
  double allowed = 0.0;      // [m] the depth allowed by the law
  double deepest = 0.0;      // [m] least translation of two cells that overlap
  // Relative to the largest kinetic energy: energy that losses and supply do not account for, the largest of all looks.
  // Relative to the sums of m |v| and m |x| |v| at the start, if nothing acts from outside: the largest change.
  double energy = 0.0, momentum = 0.0, angular = 0.0;
  bool alone = true;   // nothing acts from outside; else momenta are not compared
  bool ended = false;  // regularly
};

/// Runs a scene of tetrahedra, and inspects it `looks` times, the last at the end: cells that overlap and are no
/// neighbours, whether they are felt, and the sums.
///
/// `meddles`, for tests, is called before each look.
/// pre     bodies touch by one law
/// throws  as Simulation
ContactRun judge_run(const SceneFile& scene, std::size_t looks, const std::function<void(Simulation&)>& meddles = {});

}  // namespace dartboard
