#pragma once
// Straight ways through an obstacle: the change of energy along them, and the force whose work that is.

#include <Eigen/Core>
#include <cstdint>
#include <variant>
#include <vector>

#include "core/contact/contact_law.h"
#include "core/contact/obstacle.h"
#include "core/forces/force_term.h"
#include "core/places/joined_boxes.h"

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

/// Blocks that touch or overlap, as one solid, at places relative to the first of them.
///
/// The depth of a place in it is the distance to the nearest point of its surface. Faces between two blocks are no
/// surface, so that a place never crosses one on its way out, and nothing happens where it passes from block to block.
/// Next to a face that is covered the nearest point may be on an edge: then the normal is oblique, and turns. Where the
/// laws of blocks differ, a place has the least of the energies of all of them, each at the distance to its own part of
/// the surface: so energies are continuous there, too.
struct JoinedBlocks {
  JoinedBoxes boxes;
  std::vector<std::uint32_t> obstacle;  // by box, ascending
  std::vector<ContactLaw> law;          // by box
};

/// The penetration of the place, and the box whose surface and law count; false, and nothing is set, if it is outside.
bool find_way_out(const JoinedBlocks& joined, const Eigen::Vector3d& y, Penetration& found, std::size_t& box);

/// As for one obstacle. The force is the quotient of energy and depth, times the mean normal. Where the nearest point
/// passes from one plane or edge to another, it has a part along the way, too, that makes up for what is missing.
///
/// source  for that part: Gonzalez, J. Nonlinear Sci. 6 (1996)
EnergyChange change_on_way(const JoinedBlocks& joined, double area, const Eigen::Vector3d& y,
                           const Eigen::Vector3d& way);
Eigen::Vector3d mean_force_on_way(const JoinedBlocks& joined, double area, const Eigen::Vector3d& y,
                                  const Eigen::Vector3d& way);

}  // namespace dartboard
