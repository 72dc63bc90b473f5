#pragma once
// The conclusion of `dartboard tradeoff` from a study.

#include <string>

#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// The reason why a study proves nothing, or shows a fault; empty where all is well: its reference must resolve errors
/// of a hundredth of an edge, and some finished runs must follow its motion better than a body that stands still.
std::string trouble_of(const WorkPrecision& study);

}  // namespace dartboard
