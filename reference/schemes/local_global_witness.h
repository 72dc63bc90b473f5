#pragma once
// A step of local-global, taken again with a dense factor.

#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// The distance from twenty corrections of backward Euler's equation, or fewer if that solves it (`compare_step`).
StepJudgement judge_local_global(const SpringNetwork& network, const TakenStep& step);

}  // namespace dartboard::reference
