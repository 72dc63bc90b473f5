#pragma once
// The second gate: forces and states of all contenders are those of the first, bit for bit or within a derived bound.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "validation/contenders/contenders.h"

namespace dartboard {

/// The comparison of one contender with the first one.
struct MotionAgreement {
  std::string id;
  std::uint64_t hash = 0;            // of the contender's state after the steps
  double force_difference = 0.0;     // largest over points, as a fraction of that point's bound (bits: any is too much)
  double position_difference = 0.0;  // largest [m]
  double velocity_difference = 0.0;  // largest [m/s]
  double position_bound = 0.0;       // [m]; 0 where the bits must agree
  double velocity_bound = 0.0;       // [m/s]
  bool agrees = false;
};

/// Let every contender evaluate the forces in a deformed, moving state and take `steps` steps from it.
///
/// The walks of the core sum in the same order and must give the same bits; the others add the same terms in another
/// order and must lie within the rounding bound of reference/summation_bound. NaN agrees with nothing, and where the
/// bound is not finite no other contender agrees: such a bound says nothing.
///
/// pre     `all` is not empty; the first one is of the core
std::vector<MotionAgreement> compare_motion(const Problem& problem, int steps,
                                            std::span<const Contender> all = contenders());

}  // namespace dartboard
