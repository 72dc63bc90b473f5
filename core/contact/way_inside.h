#pragma once
// Straight ways through an obstacle: the change of energy along them, and the force whose work that is.

#include <Eigen/Core>
#include <variant>

#include "core/contact/contact_law.h"
#include "core/contact/obstacle.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// Whether the depth of the place is above 0, to rounding: a few comparisons, and no root.
inline bool is_inside(const ObstacleShape& shape, const Eigen::Vector3d& y) {
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) return (plane->point - y).dot(plane->normal) > 0.0;
  if (const auto* ball = std::get_if<Ball>(&shape))
    return (y - ball->centre).squaredNorm() < ball->radius * ball->radius;
  const auto* block = std::get_if<Block>(&shape);
  return block->low[0] < y[0] && y[0] < block->high[0] && block->low[1] < y[1] && y[1] < block->high[1] &&
         block->low[2] < y[2] && y[2] < block->high[2];
}

/// The change of the energy at a place that moves from y by `way`, from differences that do not cancel.
EnergyChange change_on_way(const ContactLaw& law, double area, const ObstacleShape& shape, const Eigen::Vector3d& y,
                           const Eigen::Vector3d& way);

/// A force [N] whose work is minus that change. It is the same in both directions, and for a way of length 0 the force
/// at y: the quotient of energy and depth, times the mean normal (half-space, ball); the mean of the force along the
/// way, from one nearest face to the next (block).
Eigen::Vector3d mean_force_on_way(const ContactLaw& law, double area, const ObstacleShape& shape,
                                  const Eigen::Vector3d& y, const Eigen::Vector3d& way);

}  // namespace dartboard
