#pragma once
// Obstacles: shapes that bodies run into, moved only by their own velocity.

#include <Eigen/Core>
#include <limits>
#include <variant>

namespace dartboard {

/// Solid where (x - point) . normal < 0.
struct HalfSpace {
  Eigen::Vector3d point{0, 0, 0};
  Eigen::Vector3d normal{0, 0, 1};  // of length 1
};
struct Ball {
  Eigen::Vector3d centre{0, 0, 0};
  double radius = 1.0;  // [m]
};
/// A box along the axes.
struct Block {
  Eigen::Vector3d low{0, 0, 0}, high{1, 1, 1};
};

using ObstacleShape = std::variant<HalfSpace, Ball, Block>;

/// A shape at its first place, and its motion: at one velocity from one time until another, without rotation.
struct Obstacle {
  ObstacleShape shape;
  Eigen::Vector3d velocity{0, 0, 0};                                   // [m/s], while it moves
  double from = 0.0, until = std::numeric_limits<double>::infinity();  // [s]

  /// Its displacement [m] until this time [s].
  Eigen::Vector3d moved_by(double time) const;
  /// Its velocity [m/s] at this time; at its ends that of the motion.
  Eigen::Vector3d velocity_at(double time) const;
  /// The largest depth possible inside [m]: half of its least thickness; infinity for a half-space. A vertex that moves
  /// further in one step may come out on the other side.
  double half_thickness() const;
  /// How far it comes [m] into a plane on which places that feel it are up to `gap` [m] apart from others, before one
  /// is inside; infinite for a ball, or a block across its two longer sides, that passes between them.
  double depth_between(double gap) const;
  /// throws  InputError for a normal that is not of length 1, a radius that is not above 0, a block without inside, or
  ///         a motion that ends before it begins
  void require_valid() const;
};

/// The depth of a place inside an obstacle, and the way out.
struct Penetration {
  double depth = 0.0;                                   // [m], > 0 inside; outside only its sign counts
  Eigen::Vector3d normal{0, 0, 0};                      // outwards, of length 1: minus the gradient of the depth
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  // [1/m]: minus the Hessian of the depth
};

/// The penetration of a place x, with the obstacle at its first place; for one that has moved, x less `moved_by`.
///
/// Depth is the distance to the nearest point of the surface, which for a block is on the nearest face: the normal
/// jumps, and the energy has a kink, where two faces are equally near. Among equals the lowest axis is taken, and its
/// lower side. At the centre of a ball there is no way out: the normal is zero there. Outside, depth is not above
/// 0; for a block, it is minus the distance to the farthest of the planes that x is beyond.
Penetration penetration(const ObstacleShape& shape, const Eigen::Vector3d& x);

}  // namespace dartboard
