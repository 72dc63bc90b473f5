#pragma once
// Borders of boxes, planes, spheres, polygons, paths and blades have a thickness, because places are computed: a place
// that should be on a border is next to it.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace dartboard {

/// The distance from a border up to which a place counts as on it [m]: a billionth of the diagonal of the points' box.
///
/// cost    O(points)
inline double border_thickness(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return 0.0;
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 1e-9 * (high - low).norm();
}

/// Is a place inside, or on the border, at this distance from the border [m], positive inside?
///
/// The border is `thickness` thick, and no less than rounding: `of` is the size of the numbers that the distance is a
/// difference of. Mean positions of vertices, unit normals and lengths are each off by a few units of rounding.
inline bool is_inside(double distance, double of, double thickness) {
  constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
  return distance >= -std::max(thickness, rounding * std::abs(of));
}

/// Whether a point is inside of a plane: where the normal points, which need not be a unit vector.
inline bool is_in_front(const Eigen::Vector3d& x, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                        double thickness) {
  const double size = std::max(x.lpNorm<Eigen::Infinity>(), point.lpNorm<Eigen::Infinity>());
  return is_inside((x - point).dot(normal.stableNormalized()), size, thickness);
}

}  // namespace dartboard
