#include "core/places/nearest_on_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The position of the point nearest to the origin on the line from p to q, from 0 to 1.
double nearest_along(const Vector3d& p, const Vector3d& q) {
  const Vector3d side = q - p;
  const double square = side.squaredNorm();
  return square > 0.0 ? std::clamp(-p.dot(side) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

NearestOnTriangle nearest_on_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, area = ab.cross(ac);
  const double square = area.squaredNorm();
  // within the triangle, seen along its normal: areas of the three parts, each as a share of the whole
  if (square > 0.0) {
    const double of_a = b.cross(c).dot(area), of_b = c.cross(a).dot(area), of_c = a.cross(b).dot(area);
    if (of_a > 0.0 && of_b > 0.0 && of_c > 0.0) {
      const double sum = of_a + of_b + of_c;
      return {{of_a / sum, of_b / sum, of_c / sum}, (a.dot(area) / square) * area};
    }
  }
  // otherwise on one of its edges
  const std::array<const Vector3d*, 3> corner{&a, &b, &c};
  NearestOnTriangle best;
  double least = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double t = nearest_along(*corner[k], *corner[next]);
    const Vector3d way = t == 1.0 ? *corner[next] : Vector3d(*corner[k] + t * (*corner[next] - *corner[k]));
    if (k > 0 && !(way.squaredNorm() < least)) continue;
    least = way.squaredNorm();
    best.weight = {};
    best.weight[k] = 1.0 - t;
    best.weight[next] = t;
    best.way = way;
  }
  return best;
}

}  // namespace dartboard
