#pragma once
// The stiffness and the damping of force terms as sparse matrices.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/forces/force_term.h"
#include "core/time/system/node_matrix.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Where and how force terms are linearised.
struct TermTangents {
  enum class Kind : std::uint8_t { exact, projected, constant };  // constant: not asked where
  StagePlaces at;
  Kind kind = Kind::exact;
};

/// K of the system's force terms on the pattern that `matrix` has, that of the system: fixed vertices have no entries
/// but zeros on the diagonal.
///
/// cost    O(vertices + pieces), each piece as its term says
void stiffness_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// C of the force terms that are damped, on the same pattern: `time` times their stiffness without stress. Of constant
/// tangents it is `time` times those.
void damping_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// How far damping is from being in proportion to the stiffness of what is damped: the stiffness of those force terms
/// less that without stress, which `time` is multiplied by.
void stiffness_of_stress(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// The largest, over the free vertices, of what the norms of the blocks in a row of M^-1 K add up to [1/s^2]: no
/// frequency is above its root (Gershgorin).
double largest_row_sum(const SpringSystem& system, const BlockMatrix& stiffness);

}  // namespace dartboard
