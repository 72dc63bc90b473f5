#include "core/places/nearest_on_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The position of the point nearest to the origin on the line from p to q, from 0 to 1.
double nearest_along(const Vector3d& p, const Vector3d& q) {
  const Vector3d side = q - p;
  const double square = side.squaredNorm();
  return square > 0.0 ? std::clamp(-p.dot(side) / square, 0.0, 1.0) : 0.0;
}

/// A part of the line from + t direction.
struct PartOfLine {
  Vector3d from, direction;
  double least, most;

  /// Leaves the part of it that is within a triangle in a plane with the line.
  void clip(const TriangleCorners& corners, const Vector3d& normal) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d inwards = normal.cross(corners[(k + 1) % 3] - corners[k]);
      const double now = inwards.dot(from - corners[k]), rate = inwards.dot(direction);
      if (rate > 0.0) least = std::max(least, -now / rate);
      if (rate < 0.0) most = std::min(most, -now / rate);
      if (rate == 0.0 && now < 0.0) most = -std::numeric_limits<double>::infinity();
    }
  }
};

Vector3d normal_of(const TriangleCorners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

}  // namespace

std::optional<NearestOnTriangle> nearest_on_both(const TriangleCorners& first, const TriangleCorners& other) {
  // planes that are this near to one have no line of certain direction
  constexpr double parallel = 1e-9;
  const Vector3d m = normal_of(first), n = normal_of(other), along = m.cross(n);
  const double square = along.squaredNorm();
  if (!(square > parallel * parallel * m.squaredNorm() * n.squaredNorm())) return {};
  // the nearest point of the line in both planes
  const Vector3d nearest = (m.dot(first[0]) * n.cross(along) + n.dot(other[0]) * along.cross(m)) / square;
  PartOfLine part{nearest, along, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  part.clip(first, m);
  part.clip(other, n);
  if (!(part.least <= part.most)) return {};
  NearestOnTriangle found;
  found.way = nearest + std::clamp(0.0, part.least, part.most) * along;
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d &p = first[(k + 1) % 3], &q = first[(k + 2) % 3];
    found.weight[k] = std::max(0.0, m.dot((q - p).cross(found.way - p)));
    sum += found.weight[k];
  }
  for (double& w : found.weight) w /= sum;
  return found;
}

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
