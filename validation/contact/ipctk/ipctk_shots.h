#pragma once
// A body shot at another: when ipctk finds the first collision, and when contact is felt or a run warns.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "validation/contact/ipctk/ipctk_questions.h"

namespace dartboard {

struct IpctkShot {
  double way = 0.0;               // in a step, over half of the least altitude of a cell
  bool warned_in_flight = false;  // of its speed, before anything is felt
  bool warned = false;            // of its speed
  IpctkQuestion question{};       // the places after each step, until contact has been felt at three of them
};

/// Cubes that are shot at the middle of a plate, turned at random, from `way` 0.1 to 100 in equal ratios. Each meets it
/// with a corner first, which is a sample: contact is felt as soon as surfaces cross by more than rounding.
/// pre  count > 0
std::vector<IpctkShot> ipctk_shots(std::size_t count, std::uint64_t seed);

struct IpctkShotsFound {
  std::size_t shots = 0;
  std::size_t slow = 0, fast = 0;  // below and above one half of the least altitude a step
  std::size_t hits = 0;            // slow ones that collide, by ipctk
  std::size_t at_once = 0;         // of these, felt after the step that collides; others are felt after the next
  std::size_t passes = 0;          // fast ones that collide without being felt after that step and the next
  // What must not be: shots that are felt before a step collides, slow ones that are felt later or not at all, slow
  // ones with a warning in flight, and fast ones without a warning.
  std::size_t early = 0, late = 0, false_warnings = 0, silent = 0;

  std::size_t wrong() const { return early + late + false_warnings + silent; }
};

/// pre  an answer for each shot
IpctkShotsFound found_by_ipctk(std::span<const IpctkShot> shots, std::span<const IpctkAnswer> answers);

}  // namespace dartboard
