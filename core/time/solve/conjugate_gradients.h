#pragma once
// Conjugate gradients, preconditioned by the 3x3 diagonal blocks or by a Cholesky factor of a similar matrix.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/time/solve/cholesky.h"
#include "core/time/solve/step_matrix.h"

namespace dartboard {

struct ConjugateGradientsOptions {
  double tolerance = 1e-6;  // of |b - A x| / |b|
  int max_iterations = 1000;
};

/// The outcome of a solution.
struct ConjugateGradientsResult {
  SolveStatus status = SolveStatus::ok;
  int iterations = 0;
  double residual = 0.0;  // |b - A x| / |b|
};

/// Conjugate gradients for a positive definite A that need not be formed.
///
/// An indefinite A may go unnoticed: it is reported as soon as a diagonal block, or a direction p with p'Ap <= 0, shows
/// it. Then x is the iterate before.
///
/// source  Hestenes, Stiefel 1952
class ConjugateGradients {
 public:
  /// Solve A x = b from the x that is given. The residual is computed again from x at the end.
  template <class Matrix>
  ConjugateGradientsResult solve(const Matrix& matrix, std::span<const Eigen::Vector3d> b, std::span<Eigen::Vector3d> x,
                                 const ConjugateGradientsOptions& options);

  /// Solve A x = b from x = 0 with the factor of a matrix near A.
  ConjugateGradientsResult solve(const StepMatrix& matrix, Cholesky& factor, std::span<const Eigen::Vector3d> b,
                                 std::span<Eigen::Vector3d> x, const ConjugateGradientsOptions& options);

  std::size_t bytes() const { return bytes_of(inverse_, r_, p_, q_); }

 private:
  std::vector<Eigen::Matrix3d> inverse_;  // of the diagonal blocks
  std::vector<Eigen::Vector3d> r_, p_, q_;
};

extern template ConjugateGradientsResult ConjugateGradients::solve(const StepMatrix&, std::span<const Eigen::Vector3d>,
                                                                   std::span<Eigen::Vector3d>,
                                                                   const ConjugateGradientsOptions&);
extern template ConjugateGradientsResult ConjugateGradients::solve(const BlockMatrix&, std::span<const Eigen::Vector3d>,
                                                                   std::span<Eigen::Vector3d>,
                                                                   const ConjugateGradientsOptions&);

}  // namespace dartboard
