#include "core/time/solve/conjugate_gradients.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/time/system/nan_proof.h"
#include "core/time/system/power_of_two.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// By Cholesky's criterion: all leading minors.
bool positive_definite(const Matrix3d& m) {
  return m(0, 0) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) > 0.0 && m.determinant() > 0.0;
}

// Minors and determinants are products of three entries: of the block scaled to near 1, they do not under- or overflow.
std::optional<Matrix3d> inverse_of_definite(const Matrix3d& block) {
  const double scale = scale_to_one(block.cwiseAbs().maxCoeff());
  const Matrix3d scaled = scale * block;
  if (!positive_definite(scaled)) return {};
  return scale * scaled.inverse();
}

}  // namespace

// Residuals and directions are those of b brought near 1 by a power of two, so that their squares neither vanish nor
// overflow, whatever the size of masses and forces; the digits are the same.
template <class Matrix>
ConjugateGradientsResult ConjugateGradients::solve(const Matrix& matrix, std::span<const Vector3d> b,
                                                   std::span<Vector3d> x, const ConjugateGradientsOptions& options) {
  const std::size_t n = b.size();
  ConjugateGradientsResult result;
  inverse_.resize(n);
  for (auto* v : {&r_, &p_, &q_}) v->resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Matrix3d& block = matrix.diagonal_block(i);
    if (!block.allFinite()) return {SolveStatus::not_finite, 0, NAN};
    const std::optional<Matrix3d> inverse = inverse_of_definite(block);
    if (!inverse) return {SolveStatus::not_positive_definite, 0, NAN};
    inverse_[i] = *inverse;
  }
  const double size = max_abs_or_nan(b);
  if (!std::isfinite(size)) return {SolveStatus::not_finite, 0, NAN};
  if (size == 0.0) {
    for (Vector3d& p : x) p.setZero();
    return result;
  }
  const double scale = scale_to_one(size);

  const auto true_residual = [&] {
    matrix.multiply(x, q_);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      r_[i] = scale * (b[i] - q_[i]);
      sum += r_[i].squaredNorm();
    }
    return sum;
  };
  double b_squared = 0.0;
  for (std::size_t i = 0; i < n; ++i) b_squared += (scale * b[i]).squaredNorm();
  const double target = options.tolerance * options.tolerance * b_squared;

  double r_squared = true_residual();
  double rz = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    p_[i] = inverse_[i] * r_[i];
    rz += r_[i].dot(p_[i]);
  }
  while (r_squared > target) {
    if (result.iterations == options.max_iterations) {
      result.status = SolveStatus::not_converged;
      break;
    }
    ++result.iterations;
    matrix.multiply(p_, q_);
    double curvature = 0.0;
    for (std::size_t i = 0; i < n; ++i) curvature += p_[i].dot(q_[i]);
    if (!std::isfinite(curvature)) {
      result.status = SolveStatus::not_finite;
      break;
    }
    if (!(curvature > 0.0)) {
      result.status = SolveStatus::not_positive_definite;
      break;
    }
    const double alpha = rz / curvature;
    double next_rz = 0.0;
    r_squared = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += (alpha / scale) * p_[i];
      r_[i] -= alpha * q_[i];
      r_squared += r_[i].squaredNorm();
      q_[i] = inverse_[i] * r_[i];
      next_rz += r_[i].dot(q_[i]);
    }
    const double beta = next_rz / rz;
    rz = next_rz;
    for (std::size_t i = 0; i < n; ++i) p_[i] = q_[i] + beta * p_[i];
  }
  result.residual = std::sqrt(true_residual() / b_squared);
  if (result.status != SolveStatus::ok) return result;
  // The residual of the recurrence drifts from the true one; if it does by more than this, the tolerance was below the
  // limit by rounding.
  if (!std::isfinite(result.residual))
    result.status = SolveStatus::not_finite;
  else if (result.residual > 10.0 * options.tolerance)
    result.status = SolveStatus::not_converged;
  return result;
}

ConjugateGradientsResult ConjugateGradients::solve(const StepMatrix& matrix, Cholesky& factor,
                                                   std::span<const Vector3d> b, std::span<Vector3d> x,
                                                   const ConjugateGradientsOptions& options) {
  const std::size_t n = b.size();
  ConjugateGradientsResult result;
  for (auto* v : {&r_, &p_, &q_}) v->resize(n);
  const auto dot = [n](std::span<const Vector3d> u, std::span<const Vector3d> v) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += u[i].dot(v[i]);
    return sum;
  };
  const double size = max_abs_or_nan(b), scale = scale_to_one(size);
  if (!std::isfinite(size)) return {SolveStatus::not_finite, 0, NAN};
  for (Vector3d& p : x) p.setZero();
  if (size == 0.0) return result;
  for (std::size_t i = 0; i < n; ++i) r_[i] = scale * b[i];
  result.status = factor.solve(r_, p_);
  if (result.status != SolveStatus::ok) return result;
  const double b_squared = dot(r_, r_);
  double rz = dot(r_, p_);
  for (;;) {
    ++result.iterations;
    matrix.multiply(p_, q_);
    const double curvature = dot(p_, q_);
    if (!std::isfinite(curvature) || !std::isfinite(rz)) {
      result.status = SolveStatus::not_finite;
    } else if (!(curvature > 0.0)) {
      result.status = SolveStatus::not_positive_definite;
    }
    if (result.status != SolveStatus::ok) return result;
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += (alpha / scale) * p_[i];
      r_[i] -= alpha * q_[i];
    }
    result.residual = std::sqrt(dot(r_, r_) / b_squared);
    if (result.residual <= options.tolerance) break;
    if (!std::isfinite(result.residual)) {
      result.status = SolveStatus::not_finite;
      break;
    }
    if (result.iterations == options.max_iterations) {
      result.status = SolveStatus::not_converged;
      break;
    }
    result.status = factor.solve(r_, q_);
    if (result.status != SolveStatus::ok) return result;
    const double next = dot(r_, q_);
    for (std::size_t i = 0; i < n; ++i) p_[i] = q_[i] + (next / rz) * p_[i];
    rz = next;
  }
  return result;
}

template ConjugateGradientsResult ConjugateGradients::solve(const StepMatrix&, std::span<const Vector3d>,
                                                            std::span<Vector3d>, const ConjugateGradientsOptions&);
template ConjugateGradientsResult ConjugateGradients::solve(const BlockMatrix&, std::span<const Vector3d>,
                                                            std::span<Vector3d>, const ConjugateGradientsOptions&);

}  // namespace dartboard
