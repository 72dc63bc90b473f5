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
  enum class Kind : std::uint8_t { exact, projected, constant };  // constant: does not depend on `at`
  StagePlaces at;
  Kind kind = Kind::exact;
};

/// K of the system's force terms on the pattern of the system, which `matrix` already has: fixed vertices have no
/// entries except zeros on the diagonal.
///
/// cost    O(vertices + pieces), each piece as its term says
void stiffness_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// C of the force terms that are damped, on the same pattern: `time` times their stiffness without stress. For constant
/// tangents it is `time` times those.
void damping_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// The deviation of damping from proportionality to stiffness: the stiffness of the damped force terms less their
/// stiffness without stress, which `time` is multiplied by.
void stiffness_of_stress(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix);

/// The largest, over the free vertices, of the sums of the norms of the blocks in a row of M^-1 K [1/s^2]: no frequency
/// is above its root (Gershgorin).
double largest_row_sum(const SpringSystem& system, const BlockMatrix& stiffness);

/// Adds `scale` times the sum of the sizes of the blocks in each row of pieces whose blocks are multiples of the
/// identity, as those of constant tangents are.
ForceTerm::VisitTangent add_row_sums(std::vector<double>& sum, double scale);

}  // namespace dartboard
