#include "reference/least_translation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace dartboard::reference {
namespace {

using Eigen::Vector3d;

/// The interval from the lowest to the highest corner along an axis.
struct Shadow {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Shadow shadow(const TetrahedronCorners& corners, const Vector3d& axis) {
  Shadow s;
  for (const Vector3d& x : corners) {
    s.low = std::min(s.low, x.dot(axis));
    s.high = std::max(s.high, x.dot(axis));
  }
  return s;
}

std::array<Vector3d, 6> edges(const TetrahedronCorners& t) {
  return {t[1] - t[0], t[2] - t[0], t[3] - t[0], t[2] - t[1], t[3] - t[1], t[3] - t[2]};
}

std::array<Vector3d, 4> face_normals(const TetrahedronCorners& t) {
  const auto e = edges(t);
  return {e[0].cross(e[1]), e[0].cross(e[2]), e[1].cross(e[2]), e[3].cross(e[4])};
}

}  // namespace

Translation least_translation(const TetrahedronCorners& a, const TetrahedronCorners& b) {
  // moved near the origin, so that tetrahedra far away lose no digits
  TetrahedronCorners p = a, q = b;
  for (Vector3d& x : p) x -= a[0];
  for (Vector3d& x : q) x -= a[0];

  Translation least{.depth = std::numeric_limits<double>::infinity()};
  const auto try_out = [&](const Vector3d& direction) {
    const double length = direction.stableNorm();
    if (length == 0.0) return;
    const Vector3d axis = direction / length;
    const Shadow first = shadow(p, axis), second = shadow(q, axis);
    const double up = first.high - second.low, down = second.high - first.low;
    if (up < least.depth) least = {up, axis};
    if (down < least.depth) least = {down, -axis};
  };
  for (const Vector3d& normal : face_normals(p)) try_out(normal);
  for (const Vector3d& normal : face_normals(q)) try_out(normal);
  for (const Vector3d& e : edges(p))
    for (const Vector3d& f : edges(q)) try_out(e.cross(f));
  return least;
}

}  // namespace dartboard::reference
