#include "reference/elements/released_motion.h"

#include <cmath>

#include "core/plain/eigenvalues.h"

namespace dartboard::reference {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ReleasedMotion::ReleasedMotion(const HeldFactor& solid, const VectorXd& force, std::size_t vectors) {
  const VectorXd start = solid.displacements(force);
  const double size = std::sqrt(solid.mass_product(start, start));
  MatrixXd v(start.size(), static_cast<Index>(vectors));
  v.col(0) = start / size;
  Index count = 1;
  for (; count < v.cols(); ++count) {
    VectorXd next = solid.displacements(solid.mass_times(v.col(count - 1)));
    const double before = std::sqrt(solid.mass_product(next, next));
    // two passes are enough: the second removes what rounding leaves of the first
    for (int pass = 0; pass < 2; ++pass)
      next -= v.leftCols(count) * (v.leftCols(count).transpose() * solid.mass_times(next));
    const double left = std::sqrt(solid.mass_product(next, next));
    if (!(left > 1e-10 * before)) break;  // the motion is in the space already
    v.col(count) = next / left;
  }
  MatrixXd stiffness(count, count);
  for (Index k = 0; k < count; ++k) stiffness.col(k) = v.leftCols(count).transpose() * solid.stiffness_times(v.col(k));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(MatrixXd(0.5 * (stiffness + stiffness.transpose())));
  omega_ = modes.eigenvalues().cwiseSqrt();
  // the start is the first vector
  const VectorXd part = size * modes.eigenvectors().row(0).transpose();
  shapes_ = v.leftCols(count) * modes.eigenvectors() * part.asDiagonal();
}

VectorXd ReleasedMotion::displacements(double t) const { return shapes_ * (omega_ * t).array().cos().matrix(); }

}  // namespace dartboard::reference
