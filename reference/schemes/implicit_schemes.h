#pragma once
// Implicit methods whose result can be put into the equations that it has to satisfy: nothing is solved again.

#include <string_view>

#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// backward-euler, implicit-midpoint, energy-momentum, sdirk2, bdf2, baraff-witkin.
bool is_implicit_scheme(std::string_view name);

/// The residual of the state after a step in the equations of the method.
///
/// pre  is_implicit_scheme(name)
StepJudgement judge_implicit_step(std::string_view name, const SpringNetwork& network, const TakenStep& step);

}  // namespace dartboard::reference
