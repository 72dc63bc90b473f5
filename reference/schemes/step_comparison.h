#pragma once
// A step compared with the same step in more digits, and with the effect of small disturbances on that.

#include <functional>
#include <vector>

#include "reference/schemes/network_state.h"
#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// Judges a step by a method that can be taken again.
///
/// witness(y) takes it from y = (x, v) in extended precision. The bound, by axis for positions and for velocities, is
/// 30 times the largest change of the result when the state is displaced by one rounding in double and when another
/// code takes the step, each in `others`; and a rounding of the result itself. So a step that amplifies rounding is
/// judged by its own amplification, and no threshold is chosen. `solver` [m, m/s] is allowed in addition.
StepJudgement compare_step(const SpringNetwork& network, const TakenStep& step,
                           const std::function<void(std::vector<Extended>&)>& witness,
                           const std::vector<std::vector<Extended>>& others = {},
                           const std::array<Extended, 2>& solver = {0, 0});

}  // namespace dartboard::reference
