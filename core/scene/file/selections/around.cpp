#include "core/scene/file/selections/selection.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/places/border.h"
#include "core/scene/file/keys/scene_value.h"
#include "core/scene/file/selections/segment.h"

namespace dartboard {

BladeSweep BladeSweep::read(const SceneValue& value) {
  BladeSweep sweep{value.get<std::vector<Eigen::Vector3d>>("path"), value.get<Eigen::Vector3d>("depth")};
  for (std::size_t k = 0; k + 1 < sweep.path.size(); ++k) {
    const Eigen::Vector3d leg = sweep.path[k + 1] - sweep.path[k];
    // the side of a parallelogram thinner than this cannot be decided
    if (!(leg.cross(sweep.depth).norm() > 1e-12 * leg.norm() * sweep.depth.norm()))
      value.fail_at(fmt::format("path/{}", k + 1), "is where the point before it is, or along the depth from there",
                    "a leg that the blade sweeps an area on");
  }
  return sweep;
}

AroundSelection AroundSelection::read(const SceneValue& value) {
  return {{value.get<std::vector<Eigen::Vector3d>>("path"), value.get<Eigen::Vector3d>("depth")},
          value.get<double>("distance")};
}

namespace {

/// The distance of a point from the parallelogram at `corner` with these sides: from its inside if the foot of the
/// perpendicular is there, otherwise from one of its edges.
double distance_to_parallelogram(const Eigen::Vector3d& x, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                                 const Eigen::Vector3d& v) {
  double least = std::min(
      std::min(distance_to_segment(x, corner, corner + u), distance_to_segment(x, corner, corner + v)),
      std::min(distance_to_segment(x, corner + u, corner + u + v), distance_to_segment(x, corner + v, corner + u + v)));
  const Eigen::Vector3d normal = u.cross(v), at = x - corner;
  const double area_2 = normal.squaredNorm();
  if (area_2 > 0.0) {
    const double s = at.cross(v).dot(normal) / area_2, t = u.cross(at).dot(normal) / area_2;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) least = std::abs(at.dot(normal)) / std::sqrt(area_2);
  }
  return least;
}

}  // namespace

bool contains(const AroundSelection& around, const Eigen::Vector3d& x, double thickness) {
  const std::vector<Eigen::Vector3d>& path = around.sweep.path;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const double size =
        std::max({x.lpNorm<Eigen::Infinity>(), path[k].lpNorm<Eigen::Infinity>(), path[k + 1].lpNorm<Eigen::Infinity>(),
                  around.sweep.depth.lpNorm<Eigen::Infinity>(), around.distance});
    const double distance = distance_to_parallelogram(x, path[k], path[k + 1] - path[k], around.sweep.depth);
    if (is_inside(around.distance - distance, size, thickness)) return true;
  }
  return false;
}

}  // namespace dartboard
