#pragma once
// What `dartboard tradeoff` concludes from a study.

#include <string>

#include "validation/tradeoff/work_precision.h"

namespace dartboard {

/// Why a study tells nothing, or tells of something wrong; empty where all is well: its reference must tell errors of a
/// hundredth of an edge, and of the runs that ended some must follow its motion better than a body that stands still.
std::string trouble_of(const WorkPrecision& study);

}  // namespace dartboard
