#include "reference/schemes/linearly_implicit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/schemes/rounding.h"
#include "reference/schemes/step_matrix.h"

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
using Vectors = std::vector<Vector>;

}  // namespace

Extended linearly_implicit_excess(const SpringNetwork& network, const Vectors& x0, const Vectors& v0, const Vectors& v1,
                                  Extended h) {
  const std::size_t n = network.point_count();
  Vectors held(n), x(x0), y(n);
  for (std::size_t i = 0; i < n; ++i) held[i] = network.fixed[i] ? v0[i] : Vector(Vector::Zero());
  for (std::size_t i = 0; i < n; ++i) x[i] += h * held[i];
  std::vector<Extended> state(6 * n), rate(6 * n);
  for (std::size_t i = 0; i < n; ++i) {
    three(state, i) = x[i];
    three(state, n + i) = held[i];
  }
  const NetworkRates<Extended> rates(network);
  rates(state.data(), rate.data());
  Vectors right(n);
  for (std::size_t i = 0; i < n; ++i) right[i] = network.mass[i] * (v0[i] + h * three(rate, n + i));
  const DenseColumn b = column_of(network, right), solution = column_of(network, v1);
  // the sizes that rounding in double acts on: in A v1, and in the forces in b
  DenseColumn sizes = b.cwiseAbs();
  for (const Spring& s : network.springs) {
    const Extended force =
        h * (std::abs(Extended(s.stiffness)) * ((x[s.b] - x[s.a]).norm() + std::abs(Extended(s.rest_length))) +
             std::abs(Extended(s.damping)) * (held[s.b] - held[s.a]).norm());
    for (const auto i : {s.a, s.b}) sizes.segment<3>(3 * static_cast<Eigen::Index>(i)).array() += force;
  }
  const std::vector<Extended> places = numbers_of(x);
  for (const ElasticPoint& point : network.elements)
    for_each_size(point, places.data(), 0, [&](std::uint32_t i, Extended size) {
      sizes.segment<3>(3 * static_cast<Eigen::Index>(i)).array() += h * size;
    });
  for (const ElasticPoint& point : network.elements)
    for_each_damping_size(point, places.data(), 0, 2 * largest_of(held), [&](std::uint32_t i, Extended size) {
      sizes.segment<3>(3 * static_cast<Eigen::Index>(i)).array() += h * size;
    });
  const auto excess = [&](const DenseMatrix& a) {
    const DenseColumn residual = b - a * solution;
    const DenseColumn allowed =
        (10 * solver_tolerance * b.norm() + (32 * epsilon * (sizes + a.cwiseAbs() * solution.cwiseAbs())).array() +
         64 * Extended(std::numeric_limits<double>::denorm_min()) * (1 + h))
            .matrix();
    Extended worst = 0;
    for (Eigen::Index c = 0; c < b.size(); ++c)
      if (!network.fixed[static_cast<std::size_t>(c / 3)] && std::isfinite(allowed[c]))
        worst = max_or_nan(worst, std::abs(residual[c]) / allowed[c]);
    return worst;
  };
  Extended worst = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (network.fixed[i] && v1[i] != v0[i]) worst = std::numeric_limits<Extended>::infinity();
  const DenseMatrix exact = step_matrix(network, x, h, Tangent::exact);
  Extended best = excess(exact);
  if (!(best <= 1) && !is_positive_definite(exact)) best = excess(step_matrix(network, x, h, Tangent::projected));
  return max_or_nan(best, worst);
}

}  // namespace dartboard::reference
