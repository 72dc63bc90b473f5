#include "reference/elements/cell_energy.h"

#include <Eigen/LU>
#include <cmath>

#include "reference/elements/elastic_law.h"

namespace dartboard::reference {
namespace {

using Matrix = Eigen::Matrix<long double, 3, 3>;

Matrix edges_of(const std::array<Eigen::Vector3d, 4>& corners) {
  Matrix edges;
  for (std::size_t k = 1; k < 4; ++k)
    edges.col(static_cast<Eigen::Index>(k) - 1) = corners[k].cast<long double>() - corners[0].cast<long double>();
  return edges;
}

}  // namespace

long double tetrahedron_energy(const Material& material, const std::array<Eigen::Vector3d, 4>& rest,
                               const std::array<Eigen::Vector3d, 4>& now) {
  const Matrix at_rest = edges_of(rest);
  return std::abs(at_rest.determinant()) / 6.0L *
         energy_density(elastic_law(material), Matrix(edges_of(now) * at_rest.inverse()));
}

}  // namespace dartboard::reference
