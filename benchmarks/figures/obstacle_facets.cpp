#include <array>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "benchmarks/figures/body_facets.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;
using Polygon = std::vector<Vector3d>;  // counterclockwise, seen from outside

/// The part of a convex polygon in a box.
Polygon within(Polygon polygon, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double limit = side < 0.0 ? box.min()[axis] : box.max()[axis];
      Polygon kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector3d &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
        const double at_here = side * (limit - here[axis]), at_next = side * (limit - next[axis]);
        if (at_here >= 0.0) kept.push_back(here);
        if ((at_here >= 0.0) != (at_next >= 0.0))
          kept.push_back(here + (next - here) * (at_here / (at_here - at_next)));
      }
      polygon = std::move(kept);
    }
  return polygon;
}

std::vector<Polygon> sides_of(const HalfSpace& plane, const Box3& reach) {
  const Vector3d middle = reach.center() - (reach.center() - plane.point).dot(plane.normal) * plane.normal;
  const Vector3d u = plane.normal.unitOrthogonal() * reach.sizes().norm(), v = plane.normal.cross(u);
  return {within({middle - u - v, middle + u - v, middle + u + v, middle - u + v}, reach)};
}

std::vector<Polygon> sides_of(const Block& block, const Box3& reach) {
  const Box3 part = Box3(block.low, block.high).intersection(reach);
  if (part.isEmpty()) return {};
  const std::array<Vector3d, 2> ends{part.min(), part.max()};
  const auto corner = [&ends](std::size_t i, std::size_t j, std::size_t k) {
    return Vector3d(ends[i].x(), ends[j].y(), ends[k].z());
  };
  return {{corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)},
          {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)},
          {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)},
          {corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)},
          {corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)},
          {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}};
}

std::vector<Polygon> sides_of(const Ball& ball, const Box3& reach) {
  constexpr int around = 48, from_pole_to_pole = 24;
  const auto at = [&ball](int i, int j) -> Vector3d {
    const double down = std::numbers::pi * i / from_pole_to_pole, turn = 2.0 * std::numbers::pi * j / around;
    return ball.centre +
           ball.radius * Vector3d(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down));
  };
  std::vector<Polygon> sides;
  for (int i = 0; i < from_pole_to_pole; ++i)
    for (int j = 0; j < around; ++j)
      sides.push_back(within({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, reach));
  return sides;
}

/// The box around an obstacle; that of a plane has no ends.
Box3 box_around(const ObstacleShape& shape) {
  if (const auto* block = std::get_if<Block>(&shape)) return {block->low, block->high};
  if (const auto* ball = std::get_if<Ball>(&shape))
    return {ball->centre - Vector3d::Constant(ball->radius), ball->centre + Vector3d::Constant(ball->radius)};
  return {Vector3d::Constant(-std::numeric_limits<double>::infinity()),
          Vector3d::Constant(std::numeric_limits<double>::infinity())};
}

}  // namespace

std::vector<DrawnFacet> facets_of_obstacles(const Look& look, double time, const Box3& reach) {
  const PictureView& view = look.view;
  // bodies are in obstacles that they touch by some of the depth of the law, and are seen all the same
  const double back = reach.isEmpty() ? 0.0 : 0.02 * reach.sizes().maxCoeff();
  std::vector<DrawnFacet> facets;
  for (const Obstacle& obstacle : look.obstacles) {
    const Vector3d moved = obstacle.moved_by(time);
    const Box3 around = box_around(obstacle.shape), here = Box3(reach).translate(-moved);
    if (reach.isEmpty() || !around.intersects(here)) continue;
    const bool is_whole = around.sizes().maxCoeff() <= 1.5 * reach.sizes().maxCoeff();
    const auto sides =
        std::visit([&](const auto& shape) { return sides_of(shape, is_whole ? around : here); }, obstacle.shape);
    const bool is_ball = std::holds_alternative<Ball>(obstacle.shape);
    for (const Polygon& side : sides) {
      if (side.size() < 3) continue;
      DrawnFacet facet{.base = colours::obstacle,
                       .of = is_ball ? DrawnFacet::Of::ball : DrawnFacet::Of::side_of_obstacle};
      for (const Vector3d& x : side) facet.corners.push_back(view.seen(x + moved) - Vector3d(0, 0, back));
      Vector3d normal(0, 0, 0);
      for (std::size_t k = 2; k < side.size(); ++k)
        normal += (facet.corners[k - 1] - facet.corners[0]).cross(facet.corners[k] - facet.corners[0]);
      normal.normalize();
      facet.outline = std::holds_alternative<HalfSpace>(obstacle.shape) && normal.z() <= 0.0;
      if (normal.z() <= 0.0 && !facet.outline) continue;
      facet.light = 0.78 + 0.22 * std::round(12.0 * std::max(0.0, normal.dot(view.light()))) / 12.0;
      facets.push_back(std::move(facet));
    }
  }
  return facets;
}

}  // namespace dartboard
