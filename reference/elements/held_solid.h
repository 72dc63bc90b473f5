#pragma once
// Linear statics and modes of a solid with a stiffness and a mass, some of its nodes held.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

namespace dartboard::reference {

/// Three unknowns for each node in turn; both matrices symmetric, the mass positive definite.
struct HeldSolid {
  Eigen::SparseMatrix<double> stiffness, mass;  // [N/m], [kg]
  std::vector<std::uint32_t> held;              // nodes that do not move

  /// The displacements [m] at rest under these forces [N].
  /// throws  SolverError if the solid is free to move
  Eigen::VectorXd displacements(const Eigen::VectorXd& force) const;

  /// The lowest angular frequencies [1/s], ascending: subspace iteration until they are constant to 1e-10.
  /// throws  SolverError if the solid is free to move
  std::vector<double> frequencies(std::size_t count) const;
};

}  // namespace dartboard::reference
