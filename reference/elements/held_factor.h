#pragma once
// A solid that is held, with its stiffness factored once for all answers.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "reference/elements/held_solid.h"

namespace dartboard::reference {

class HeldFactor {
 public:
  /// cost    that of the factor; the answers below cost little in comparison
  /// throws  SolverError if the solid is free to move
  explicit HeldFactor(const HeldSolid& solid);

  /// The displacements [m] at rest under these forces [N].
  Eigen::VectorXd displacements(const Eigen::VectorXd& force) const;
  /// The lowest angular frequencies [1/s], ascending: subspace iteration until they are constant to 1e-10.
  std::vector<double> frequencies(std::size_t count) const;
  /// u'Mv [kg m^2]
  double mass_product(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const { return u.dot(mass_ * v); }
  Eigen::VectorXd mass_times(const Eigen::VectorXd& u) const { return mass_ * u; }
  Eigen::VectorXd stiffness_times(const Eigen::VectorXd& u) const { return stiffness_ * u; }

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse stiffness_, mass_;  // of all unknowns
  Sparse free_;              // the selection of the free unknowns, one in each column
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
};

}  // namespace dartboard::reference
