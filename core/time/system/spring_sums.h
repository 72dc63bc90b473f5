#pragma once
// The sums of the forces of all springs at each vertex, by as many threads as have shares.

#include <Eigen/Core>
#include <span>

#include "core/base/padded_vector.h"
#include "core/time/system/accelerations.h"

namespace dartboard {

/// Set the forces [N] of all vertices to the sums of those of the springs at x [m], v [m/s], in the order of their
/// numbers; with damping if `terms` has it. Forces that `are_zero` before need not be cleared.
///
/// pre     force aliases neither x nor v; v is read only for damping
template <class Row>  // Eigen::Vector3d or PaddedVector
void sum_spring_forces(const SpringSystem& system, const Terms& terms, std::span<const Row> x, std::span<const Row> v,
                       std::span<Row> force, bool are_zero = false);

}  // namespace dartboard
