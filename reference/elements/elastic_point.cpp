#include "reference/elements/elastic_point.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard::reference {
namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

std::vector<Vector> corners_at_rest(const Mesh& rest, std::size_t cell) {
  std::vector<Vector> corners;
  for (const std::uint32_t node : rest.cell(cell)) corners.push_back(rest.points[node].cast<Real>());
  return corners;
}

// The point for slopes by the element's own coordinates, with its share of the determinant.
ElasticPoint mapped(const ElasticLaw& law, Real damping_time, const std::vector<std::uint32_t>& at,
                    const std::vector<Vector>& corners, const std::vector<Vector>& slopes, Real share) {
  Matrix3<Real> jacobian = Matrix3<Real>::Zero();
  for (std::size_t a = 0; a < corners.size(); ++a) jacobian += corners[a] * slopes[a].transpose();
  const Matrix3<Real> inverse = jacobian.inverse();
  ElasticPoint point{law, share * std::abs(jacobian.determinant()), at, {}};
  for (const Vector& slope : slopes) point.gradient.push_back(inverse.transpose() * slope);
  point.damping_time = damping_time;
  return point;
}

// N = (1 + r r_a)(1 + s s_a)(1 + t t_a) / 8 on the cube [-1, 1]^3
std::vector<Vector> trilinear_slopes(const Vector& at) {
  std::vector<Vector> slopes;
  for (int a = 0; a < 8; ++a) {
    const int ring = a % 4;
    const Vector corner(ring == 1 || ring == 2 ? 1 : -1, ring >= 2 ? 1 : -1, a >= 4 ? 1 : -1);
    const Vector one = Vector::Ones() + at.cwiseProduct(corner);
    slopes.push_back(Vector(corner[0] * one[1] * one[2], corner[1] * one[2] * one[0], corner[2] * one[0] * one[1]) / 8);
  }
  return slopes;
}

}  // namespace

std::vector<ElasticPoint> elastic_points(const Mesh& rest, std::size_t cell, const Material& material) {
  const ElasticLaw law = elastic_law(material);
  const Real time = material.damping_time;
  const std::vector<Vector> corners = corners_at_rest(rest, cell);
  const std::vector<std::uint32_t> at(rest.cell(cell).begin(), rest.cell(cell).end());
  if (rest.kinds[cell] == CellKind::tetrahedron)
    return {mapped(law, time, at, corners, {-Vector::Ones(), Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()},
                   1 / Real(6))};
  if (rest.kinds[cell] != CellKind::hexahedron)
    throw InputError(
        fmt::format("cell {} is a {}; expected a tetrahedron or a hexahedron", cell, name(rest.kinds[cell])));
  std::vector<ElasticPoint> points;
  for (int q = 0; q < 8; ++q) {  // in the order of the corners, which a sweep over points has to have
    const int ring = q % 4;
    const Vector at_point =
        Vector(ring == 1 || ring == 2 ? 1 : -1, ring >= 2 ? 1 : -1, q >= 4 ? 1 : -1) / std::sqrt(Real(3));
    points.push_back(mapped(law, time, at, corners, trilinear_slopes(at_point), 1));
  }
  return points;
}

Matrix3<Real> stiffness_block(const ElasticPoint& point, const StressSlope& slope, std::size_t a, std::size_t b) {
  Matrix3<Real> block = Matrix3<Real>::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      block += point.volume * point.gradient[a][i] * point.gradient[b][j] * slope.block<3, 3>(3 * i, 3 * j);
  return block;
}

Matrix3<Real> damping_block(const ElasticPoint& point, const Matrix3<Real>& f, std::size_t a, std::size_t b) {
  Matrix3<Real> block;
  for (int k = 0; k < 3; ++k) {
    const Matrix3<Real> rate = Vector::Unit(k) * point.gradient[b].transpose();
    block.col(k) = point.volume * (damping_stress(point, f, rate) * point.gradient[a]);
  }
  return block;
}

}  // namespace dartboard::reference
