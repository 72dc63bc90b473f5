#pragma once
// `dartboard validate elements`: what does the exact tangent of corotational elements save?

#include <span>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/statics/newton_matrices.h"

namespace dartboard {

/// Under each load the exact tangent takes the fewest iterations, fewer than warped stiffness; all that converge end at
/// the same place.
Claim claim_on(std::span<const NewtonRun> runs);
Table newton_table(std::span<const NewtonRun> runs);

}  // namespace dartboard
