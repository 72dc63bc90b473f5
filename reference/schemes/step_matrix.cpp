#include "reference/schemes/step_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace dartboard::reference {

using Vector = Vector3<Extended>;
using Matrix = Matrix3<Extended>;

namespace {

Matrix damping_of(const Spring& spring, const Vector& line) {
  const Extended length = line.norm();
  if (length == 0) return Matrix::Zero();
  return spring.damping / (length * length) * line * line.transpose();
}

}  // namespace

Matrix stiffness_of(const Spring& spring, const Vector& line, Tangent tangent) {
  const Extended length = line.norm();
  if (length == 0) return spring.stiffness * Matrix::Identity();
  const Vector along = line / length;
  const Extended turn = spring.stiffness * (1 - spring.rest_length / length);
  const Extended across = tangent == Tangent::projected ? std::max<Extended>(turn, 0) : turn;
  return across * Matrix::Identity() + (spring.stiffness - across) * along * along.transpose();
}

StressSlope slope_of(const ElasticPoint& point, const Extended* x, Tangent tangent) {
  const StressSlope slope = stress_slope(point.law, deformation(point, x));
  if (tangent == Tangent::exact) return slope;
  const Eigen::SelfAdjointEigenSolver<StressSlope> solver((slope + slope.transpose()) / 2);
  const auto& v = solver.eigenvectors();
  return v * solver.eigenvalues().cwiseMax(0).asDiagonal() * v.transpose();
}

DenseMatrix step_matrix(const SpringNetwork& network, const std::vector<Vector>& x, Extended tau, Tangent tangent) {
  const auto n = static_cast<Eigen::Index>(network.point_count());
  DenseMatrix a = DenseMatrix::Zero(3 * n, 3 * n);
  const auto fixed = [&](Eigen::Index i) { return network.fixed[static_cast<std::size_t>(i)] != 0; };
  for (Eigen::Index i = 0; i < n; ++i)
    a.diagonal().segment<3>(3 * i).setConstant(
        fixed(i) ? Extended(1) : network.mass[static_cast<std::size_t>(i)] * (1 + tau * Extended(network.viscosity)));
  for (const Spring& s : network.springs) {
    const Vector line = x[s.b] - x[s.a];
    const Matrix block = tau * tau * stiffness_of(s, line, tangent) + tau * damping_of(s, line);
    for (const Eigen::Index i : {s.a, s.b})
      for (const Eigen::Index j : {s.a, s.b})
        if (!fixed(i) && !fixed(j)) a.block<3, 3>(3 * i, 3 * j) += (i == j ? 1 : -1) * block;
  }
  const std::vector<Extended> places = numbers_of(x);
  for (const ElasticPoint& point : network.elements) {
    const StressSlope slope = slope_of(point, places.data(), tangent);
    const Matrix f = deformation(point, places.data());
    for (std::size_t p = 0; p < point.corner.size(); ++p)
      for (std::size_t q = 0; q < point.corner.size(); ++q) {
        const Eigen::Index i = point.corner[p], j = point.corner[q];
        if (fixed(i) || fixed(j)) continue;
        a.block<3, 3>(3 * i, 3 * j) += tau * tau * stiffness_block(point, slope, p, q);
        if (point.damping_time != 0) a.block<3, 3>(3 * i, 3 * j) += tau * damping_block(point, f, p, q);
      }
  }
  return a;
}

bool is_positive_definite(const DenseMatrix& a) { return Eigen::LLT<DenseMatrix>(a).info() == Eigen::Success; }

DenseColumn column_of(const SpringNetwork& network, const std::vector<Vector>& b) {
  DenseColumn column = DenseColumn::Zero(3 * static_cast<Eigen::Index>(b.size()));
  for (std::size_t i = 0; i < b.size(); ++i)
    if (!network.fixed[i]) column.segment<3>(3 * static_cast<Eigen::Index>(i)) = b[i];
  return column;
}

}  // namespace dartboard::reference
