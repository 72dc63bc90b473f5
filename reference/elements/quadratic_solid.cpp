#include "reference/elements/quadratic_solid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/plain/error.h"

namespace dartboard::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A polynomial in the four barycentric coordinates: coefficients by their exponents.
using Polynomial = std::map<std::array<int, 4>, double>;

Polynomial power_of(std::size_t i) {
  Polynomial p;
  std::array<int, 4> exponents{};
  exponents[i] = 1;
  p[exponents] = 1.0;
  return p;
}
Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial product;
  for (const auto& [e, x] : a)
    for (const auto& [f, y] : b) product[{e[0] + f[0], e[1] + f[1], e[2] + f[2], e[3] + f[3]}] += x * y;
  return product;
}
Polynomial sum(const Polynomial& a, double factor, const Polynomial& b) {
  Polynomial result = a;
  for (const auto& [e, x] : b) result[e] += factor * x;
  return result;
}

/// The integral over a tetrahedron of volume 1: 6 a! b! c! d! / (a + b + c + d + 3)!.
double integral(const Polynomial& p) {
  double result = 0.0;
  for (const auto& [e, x] : p)
    result += x * 6.0 * std::tgamma(e[0] + 1) * std::tgamma(e[1] + 1) * std::tgamma(e[2] + 1) * std::tgamma(e[3] + 1) /
              std::tgamma(e[0] + e[1] + e[2] + e[3] + 4);
  return result;
}

/// The tables for every tetrahedron: integrals of products of the ten functions, and of products of their
/// derivatives by barycentric coordinates, over a volume of 1.
struct Tables {
  Eigen::Matrix<double, 10, 10> mass;
  std::array<std::array<Eigen::Matrix4d, 10>, 10> slopes;  // [a][b](k, l): d N_a / d lambda_k times d N_b / d lambda_l

  Tables() {
    std::array<Polynomial, 10> shape;
    std::array<std::array<Polynomial, 4>, 10> slope;
    const Polynomial one{{{0, 0, 0, 0}, 1.0}}, none;
    for (std::size_t a = 0; a < 10; ++a) {
      for (Polynomial& p : slope[a]) p = none;
      if (a < 4) {
        shape[a] = sum(times(power_of(a), sum(none, 2.0, power_of(a))), -1.0, power_of(a));  // l (2 l - 1)
        slope[a][a] = sum(sum(none, 4.0, power_of(a)), -1.0, one);
      } else {
        const auto [i, j] = edges[a - 4];
        shape[a] = sum(none, 4.0, times(power_of(i), power_of(j)));
        slope[a][i] = sum(none, 4.0, power_of(j));
        slope[a][j] = sum(none, 4.0, power_of(i));
      }
    }
    for (std::size_t a = 0; a < 10; ++a)
      for (std::size_t b = 0; b < 10; ++b) {
        mass(static_cast<int>(a), static_cast<int>(b)) = integral(times(shape[a], shape[b]));
        for (std::size_t k = 0; k < 4; ++k)
          for (std::size_t l = 0; l < 4; ++l)
            slopes[a][b](static_cast<int>(k), static_cast<int>(l)) = integral(times(slope[a][k], slope[b][l]));
      }
  }
};

}  // namespace

QuadraticSolid::QuadraticSolid(const Mesh& mesh, const ElasticSolid& material) : nodes_(mesh.points) {
  static const Tables tables;
  const double mu = material.young / (2.0 * (1.0 + material.poisson));
  const double lambda = material.young * material.poisson / ((1.0 + material.poisson) * (1.0 - 2.0 * material.poisson));
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> middle;
  std::map<std::array<std::uint32_t, 3>, std::pair<int, Face>> faces;
  std::vector<Eigen::Triplet<double>> stiffness, masses;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    if (mesh.kinds[c] != CellKind::tetrahedron)
      throw InputError(fmt::format("cell {} is a {}, expected a tetrahedron", c, name(mesh.kinds[c])));
    std::array<std::uint32_t, 10> node{cell[0], cell[1], cell[2], cell[3]};
    const auto middle_of = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] =
          middle.try_emplace({std::min(i, j), std::max(i, j)}, static_cast<std::uint32_t>(nodes_.size()));
      if (is_new) nodes_.push_back(0.5 * (nodes_[i] + nodes_[j]));
      return at->second;
    };
    for (std::size_t e = 0; e < 6; ++e) node[4 + e] = middle_of(cell[edges[e][0]], cell[edges[e][1]]);
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint32_t, 3> corners{cell[(left_out + 1) % 4], cell[(left_out + 2) % 4],
                                           cell[(left_out + 3) % 4]};
      std::ranges::sort(corners);
      const auto [i, j, k] = corners;
      auto& found = faces[corners];
      ++found.first;
      found.second = {i, j, k, middle_of(i, j), middle_of(j, k), middle_of(k, i)};
    }

    Matrix3d sides;
    for (int k = 0; k < 3; ++k)
      sides.col(k) = mesh.points[cell[static_cast<std::size_t>(k) + 1]] - mesh.points[cell[0]];
    const double volume = std::abs(sides.determinant()) / 6.0;
    if (!(volume > 0.0)) throw InputError(fmt::format("cell {} has no volume", c));
    Eigen::Matrix<double, 3, 4> gradient;  // of the barycentric coordinates
    gradient.rightCols<3>() = sides.inverse().transpose();
    gradient.col(0) = -gradient.rightCols<3>().rowwise().sum();
    for (std::size_t a = 0; a < 10; ++a)
      for (std::size_t b = 0; b < 10; ++b) {
        // integral of grad N_a (grad N_b)'
        const Matrix3d g = volume * gradient * tables.slopes[a][b] * gradient.transpose();
        const Matrix3d block = lambda * g + mu * g.transpose() + mu * g.trace() * Matrix3d::Identity();
        const double m = material.density * volume * tables.mass(static_cast<int>(a), static_cast<int>(b));
        for (int r = 0; r < 3; ++r) {
          const int row = static_cast<int>(3 * node[a]) + r;
          masses.emplace_back(row, static_cast<int>(3 * node[b]) + r, m);
          for (int s = 0; s < 3; ++s) stiffness.emplace_back(row, static_cast<int>(3 * node[b]) + s, block(r, s));
        }
      }
  }
  for (const auto& [corners, found] : faces)
    if (found.first == 1) boundary_.push_back(found.second);
  const auto unknowns = static_cast<Eigen::Index>(3 * nodes_.size());
  stiffness_.resize(unknowns, unknowns);
  mass_.resize(unknowns, unknowns);
  stiffness_.setFromTriplets(stiffness.begin(), stiffness.end());
  mass_.setFromTriplets(masses.begin(), masses.end());
}

// An affine traction sum t_k l_k against the functions of a quadratic triangle. Over an area of 1, l_k N_a integrates
// to 1/30 at its own corner and -1/60 at another; to 2/15 in the middle of a side at the corner and 1/15 across.
void QuadraticSolid::add_face(const Face& face, const std::array<Vector3d, 3>& traction, VectorXd& force) const {
  const double area = 0.5 * (nodes_[face[1]] - nodes_[face[0]]).cross(nodes_[face[2]] - nodes_[face[0]]).norm();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto add = [&](std::size_t node, double weight) {
      force.segment<3>(3 * static_cast<Eigen::Index>(face[node])) += weight * area * traction[k];
    };
    for (std::size_t a = 0; a < 3; ++a) add(a, a == k ? 1.0 / 30.0 : -1.0 / 60.0);
    for (std::size_t side = 0; side < 3; ++side) add(3 + side, side == (k + 1) % 3 ? 1.0 / 15.0 : 2.0 / 15.0);
  }
}

}  // namespace dartboard::reference
