#pragma once
// The state of a network as one vector, (x of all points, v of all points), in any precision.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/plain/nan_maximum.h"
#include "reference/spring_network.h"

namespace dartboard::reference {

using Extended = long double;
template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;

template <class Real>
std::vector<Real> vector_of(const PointState& state) {
  std::vector<Real> y;
  y.reserve(6 * state.x.size());
  for (const auto* column : {&state.x, &state.v})
    for (const Eigen::Vector3d& p : *column)
      for (const double c : p) y.push_back(c);
  return y;
}

/// The three numbers of point i; for its velocity, i counts on after the positions.
template <class Real>
Eigen::Map<Vector3<Real>> three(std::vector<Real>& y, std::size_t i) {
  return Eigen::Map<Vector3<Real>>(y.data() + 3 * i);
}
template <class Real>
Eigen::Map<const Vector3<Real>> three(const std::vector<Real>& y, std::size_t i) {
  return Eigen::Map<const Vector3<Real>>(y.data() + 3 * i);
}

/// All positions of a state, or, with half = 1, all velocities.
inline std::vector<Vector3<Extended>> part_of(const std::vector<Extended>& y, std::size_t half) {
  const std::size_t n = y.size() / 6;
  std::vector<Vector3<Extended>> result;
  for (std::size_t i = 0; i < n; ++i) result.emplace_back(three(y, half * n + i));
  return result;
}

/// Three numbers of each point, one after another.
inline std::vector<Extended> numbers_of(const std::vector<Vector3<Extended>>& column) {
  std::vector<Extended> numbers;
  numbers.reserve(3 * column.size());
  for (const Vector3<Extended>& p : column) numbers.insert(numbers.end(), p.begin(), p.end());
  return numbers;
}

/// The largest number, by size; NaN where one is.
inline Extended largest_of(const Vector3<Extended>& p) {
  return max_or_nan(max_or_nan(std::abs(p[0]), std::abs(p[1])), std::abs(p[2]));
}
inline Extended largest_of(const std::vector<Vector3<Extended>>& column) {
  Extended largest = 0;
  for (const Vector3<Extended>& p : column) largest = max_or_nan(largest, largest_of(p));
  return largest;
}

}  // namespace dartboard::reference
