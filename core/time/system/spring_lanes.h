#pragma once
// The forces of springs, four at a time where the processor has AVX2, with the bits of one at a time.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/padded_vector.h"
#include "core/forces/spring_force.h"
#include "core/forces/springs.h"

namespace dartboard {

/// What a loop over springs reads and writes: columns by vertex number, ends by spring number.
template <class Row>  // Eigen::Vector3d or PaddedVector
struct SpringColumnsAt {
  const SpringEnds* ends;
  std::span<const Row> x;  // [m]
  const Row* v;            // [m/s] read only with damping
  Row* force;              // [N] added to
};

/// Add the forces of the springs from `first` to before `last`, one after the other.
///
/// Columns are accessed by local pointers: stores of Eigen's packets may alias anything, so a pointer accessed through
/// a reference is loaded again after each store.
template <bool damped, class Row, class SomeSpring>
inline void add_forces_one_by_one(const SpringColumnsAt<Row>& at, const SomeSpring* row, std::size_t first,
                                  std::size_t last) {
  const SpringEnds* const ends = at.ends;
  const Row *const place = at.x.data(), *const velocity = at.v;
  Row* const sum = at.force;
  for (std::size_t s = first; s < last; ++s) {
    const auto [i, j] = ends[s];
    const SomeSpring& spring = row[s];
    const Eigen::Vector3d dx = three_of(place[j]) - three_of(place[i]);
    Eigen::Vector3d f;
    if constexpr (damped) {
      f = spring_force(spring, dx, three_of(velocity[j]) - three_of(velocity[i]));
    } else {
      const double length = std::sqrt(dx.squaredNorm());
      if (length == 0.0) continue;
      f = (spring.stiffness * (length - spring.rest_length) * (1.0 / length)) * dx;
    }
    three_of(sum[i]) += f;
    three_of(sum[j]) -= f;
  }
}

/// Adds the forces of all springs but less than four at the end, if the processor has AVX2. Lengths, directions and
/// tensions are computed for four springs at a time by the operations of `spring_force` in their order; then the four
/// add to their ends one after the other. So each sum has the order and the bits that it has one by one.
///
/// returns  the number of springs added; 0 without AVX2, or where lanes are off (lanes.h)
/// cost     2.4 to 3.2 ns a spring where the columns fit the cache, 0.65 to 0.75 of one by one; 0.8 of that in padded
///          rows, which are loaded and stored whole
template <bool damped, class Row, class SomeSpring>
std::size_t add_forces_in_lanes(const SpringColumnsAt<Row>& at, std::span<const SomeSpring> springs);

/// The unit vector from the first end of a spring to the second; zero for zero length.
inline Eigen::Vector3d direction_of(const SpringEnds& ends, const Eigen::Vector3d* x) {
  const Eigen::Vector3d d = x[ends[1]] - x[ends[0]];
  const double length = std::sqrt(d.squaredNorm());
  if (length == 0.0) return {0, 0, 0};
  return (1.0 / length) * d;
}
/// Finds the directions of all springs but less than four at the end, four at a time with AVX2, with the same bits.
///
/// returns  as add_forces_in_lanes
std::size_t find_directions_in_lanes(std::span<const SpringEnds> ends, std::span<const Eigen::Vector3d> x,
                                     Eigen::Vector3d* directions);

}  // namespace dartboard
