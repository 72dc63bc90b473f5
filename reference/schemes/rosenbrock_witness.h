#pragma once
// A step of ros2, taken again with dense factors.

#include "reference/schemes/taken_step.h"

namespace dartboard::reference {

/// The distance from the method's step (`compare_step`), whose linear systems are solved to 1e-12. With exact tangents;
/// if their matrix is not positive definite, projected ones are accepted as well.
StepJudgement judge_rosenbrock(const SpringNetwork& network, const TakenStep& step);

}  // namespace dartboard::reference
