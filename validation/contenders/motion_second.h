#pragma once
// The third gate: a second of motion, against the same steps in extended precision by code that shares nothing with
// core.

#include <span>
#include <string>
#include <vector>

#include "validation/contenders/contenders.h"

namespace dartboard {

/// The largest deviation of a contender, in spreads of rounding (reference/schemes/extended_motion.h): it rounds some
/// ten times in a step, the spread once.
inline constexpr double spreads_of_a_second = 10.0;

/// The state of one contender after so many steps.
struct SecondOfMotion {
  std::string id;
  int steps = 0;
  double travelled = 0.0;                             // [m] the largest displacement of a point, in the witness
  double position = 0.0, velocity = 0.0;              // largest difference of a coordinate from the witness [m], [m/s]
  double position_bound = 0.0, velocity_bound = 0.0;  // spreads_of_a_second spreads
  bool agrees = false;
};

/// The representatives of all contenders: the fastest way to walk each kind of body. Walks of one kind agree bit for
/// bit, or within a rounding bound, over ten steps (motion_agreement.h), and a second of the slow ones would take ten.
std::vector<Contender> contenders_for_a_second();

/// Let contenders move for `seconds` of the problem's steps from its start. NaN agrees with nothing.
std::vector<SecondOfMotion> compare_second(const Problem& problem, double seconds, std::span<const Contender> all);

}  // namespace dartboard
