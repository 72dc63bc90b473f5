#pragma once
// A step of ros2, taken again with dense factors.

#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// The distance from the method's step (`compare_step`), whose linear systems are solved to 1e-12. With exact tangents;
/// where their matrix is not positive definite, projected ones will do as well.
StepJudgement judge_rosenbrock(const SpringNetwork& network, const TakenStep& step);

}  // namespace dartboard::reference
