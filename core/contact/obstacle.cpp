#include "core/contact/obstacle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Penetration penetration_in(const HalfSpace& plane, const Vector3d& x) {
  return {(plane.point - x).dot(plane.normal), plane.normal};
}

Penetration penetration_in(const Ball& ball, const Vector3d& x) {
  const Vector3d out = x - ball.centre;
  const double distance = std::sqrt(out.squaredNorm());
  Penetration found;
  found.depth = ball.radius - distance;
  if (distance == 0.0) return found;
  found.normal = out / distance;
  found.curvature = (Matrix3d::Identity() - found.normal * found.normal.transpose()) / distance;
  return found;
}

Penetration penetration_in(const Block& block, const Vector3d& x) {
  Penetration found;
  found.depth = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    for (const bool above : {false, true}) {
      const double depth = above ? block.high[k] - x[k] : x[k] - block.low[k];
      if (depth >= found.depth) continue;
      found.depth = depth;
      found.normal = (above ? 1.0 : -1.0) * Vector3d::Unit(k);
    }
  return found;
}

}  // namespace

Vector3d Obstacle::moved_by(double time) const {
  const double end = std::min(time, until);
  return end > from ? (end - from) * velocity : Vector3d(0, 0, 0);
}

Vector3d Obstacle::velocity_at(double time) const {
  return from <= time && time <= until ? velocity : Vector3d(0, 0, 0);
}

double Obstacle::half_thickness() const {
  if (const auto* ball = std::get_if<Ball>(&shape)) return ball->radius;
  if (const auto* block = std::get_if<Block>(&shape)) return 0.5 * (block->high - block->low).minCoeff();
  return std::numeric_limits<double>::infinity();
}

double Obstacle::depth_between(double gap) const {
  constexpr double all = std::numeric_limits<double>::infinity();
  if (const auto* ball = std::get_if<Ball>(&shape)) {
    const double inside = ball->radius * ball->radius - gap * gap;
    return inside > 0.0 ? ball->radius - std::sqrt(inside) : all;
  }
  if (const auto* block = std::get_if<Block>(&shape)) {
    const Vector3d half = 0.5 * (block->high - block->low);
    // the middle one of the three
    const double middle = half.sum() - half.minCoeff() - half.maxCoeff();
    return middle <= gap ? all : 0.0;
  }
  return 0.0;
}

void Obstacle::require_valid() const {
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) {
    // a direction that was divided by its length has length 1 to a few roundings
    if (!(std::abs(plane->normal.norm() - 1.0) < 1e-14))
      throw InputError(fmt::format("the normal of an obstacle is {} long, expected 1", plane->normal.norm()));
  } else if (const auto* ball = std::get_if<Ball>(&shape)) {
    if (!(ball->radius > 0.0))
      throw InputError(fmt::format("the radius of an obstacle is {}, expected more than 0", ball->radius));
  } else if (const auto* block = std::get_if<Block>(&shape)) {
    for (int k = 0; k < 3; ++k)
      if (!(block->low[k] < block->high[k]))
        throw InputError(fmt::format("an obstacle reaches from {} to {} along axis {}, expected some thickness",
                                     block->low[k], block->high[k], k));
  }
  if (!(until >= from))
    throw InputError(
        fmt::format("an obstacle moves from {} s until {} s, expected an end after its beginning", from, until));
}

Penetration penetration(const ObstacleShape& shape, const Vector3d& x) {
  return std::visit([&x](const auto& s) { return penetration_in(s, x); }, shape);
}

}  // namespace dartboard
