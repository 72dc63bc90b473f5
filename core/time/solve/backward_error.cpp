#include "core/time/solve/backward_error.h"

#include "core/time/system/nan_proof.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// |A| y, for y without negative coordinates.
std::vector<Vector3d> absolute_product(const BlockMatrix& m, std::span<const Vector3d> y) {
  std::vector<Vector3d> result(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) result[i] = m.diagonal[i].cwiseAbs() * y[i];
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k) {
      result[j] += m.below[k].transpose().cwiseAbs() * y[m.pattern.row[k]];
      result[m.pattern.row[k]] += m.below[k].cwiseAbs() * y[j];
    }
  return result;
}

}  // namespace

std::vector<ExtendedVector> extended_residual(const BlockMatrix& m, std::span<const Vector3d> b,
                                              std::span<const Vector3d> x) {
  std::vector<ExtendedVector> r(b.size());
  for (std::size_t i = 0; i < b.size(); ++i)
    r[i] = b[i].cast<long double>() - m.diagonal[i].cast<long double>() * x[i].cast<long double>();
  for (std::size_t j = 0; j < b.size(); ++j)
    for (std::uint32_t k = m.pattern.column_start[j]; k < m.pattern.column_start[j + 1]; ++k) {
      const Eigen::Matrix<long double, 3, 3> block = m.below[k].cast<long double>();
      r[j] -= block.transpose() * x[m.pattern.row[k]].cast<long double>();
      r[m.pattern.row[k]] -= block * x[j].cast<long double>();
    }
  return r;
}

double backward_error(const BlockMatrix& m, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  const std::vector<ExtendedVector> r = extended_residual(m, b, x);
  std::vector<Vector3d> size(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) size[i] = x[i].cwiseAbs();
  const std::vector<Vector3d> scale = absolute_product(m, size);
  double error = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto left = static_cast<double>(std::abs(r[i][c]));
      error = max_or_nan(error, left == 0.0 ? 0.0 : left / (scale[i][c] + std::abs(b[i][c])));
    }
  return error;
}

double normwise_backward_error(const BlockMatrix& m, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  const std::vector<ExtendedVector> r = extended_residual(m, b, x);
  const std::vector<Vector3d> rows = absolute_product(m, std::vector<Vector3d>(x.size(), Vector3d::Ones()));
  double left = 0.0;
  for (const ExtendedVector& p : r)
    for (int c = 0; c < 3; ++c) left = max_or_nan(left, static_cast<double>(std::abs(p[c])));
  return left == 0.0 ? 0.0 : left / (max_abs_or_nan(rows) * max_abs_or_nan(x) + max_abs_or_nan(b));
}

}  // namespace dartboard
