#include "core/scene/file/selections/selection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/places/border.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/selections/segment.h"

namespace dartboard {

PolygonSelection PolygonSelection::read(const SceneValue& value, const Eigen::Vector3d& along) {
  auto corners = value.as<std::vector<Eigen::Vector3d>>();
  double twice_area = 0.0, around = 0.0;  // twice_area: the largest of a triangle with the first corner
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d &here = corners[k], &next = corners[(k + 1) % corners.size()];
    twice_area = std::max(twice_area, std::abs((here - corners[0]).cross(next - corners[0]).dot(along)));
    around += (next - here).norm();
  }
  constexpr double flat = 1e-9;
  if (!(twice_area > flat * around * around))
    value.fail("has no area as seen along the plane's normal", "corners that enclose one");
  return {along, std::move(corners)};
}

bool contains(const PolygonSelection& polygon, const Eigen::Vector3d& x, double thickness) {
  const Eigen::Vector3d right = polygon.along.unitOrthogonal(), up = polygon.along.cross(right);
  const auto seen = [&](const Eigen::Vector3d& d) { return Eigen::Vector3d(d.dot(right), d.dot(up), 0.0); };
  bool inside = false;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Eigen::Vector3d a = polygon.corners[k] - x, b = polygon.corners[(k + 1) % polygon.corners.size()] - x;
    const double size =
        std::max({x.lpNorm<Eigen::Infinity>(), a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>()});
    if (is_inside(-distance_to_segment({0, 0, 0}, seen(a), seen(b)), size, thickness)) return true;  // on its border
    const double a_up = a.dot(up), b_up = b.dot(up);
    if ((a_up > 0.0) == (b_up > 0.0)) continue;
    if (a.dot(right) + a_up / (a_up - b_up) * (b - a).dot(right) > 0.0) inside = !inside;
  }
  return inside;
}

}  // namespace dartboard
