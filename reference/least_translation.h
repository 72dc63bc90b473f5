#pragma once
// The depth of the overlap of two tetrahedra, by separating axes.

#include <Eigen/Core>
#include <array>

namespace dartboard::reference {

using TetrahedronCorners = std::array<Eigen::Vector3d, 4>;

/// The translation that separates two tetrahedra: the second one moved by depth times along.
struct Translation {
  double depth = 0.0;              // [m]; below 0 where they are apart, by no more than their distance
  Eigen::Vector3d along{0, 0, 0};  // of length 1; 0 where both are points
};

/// The shortest translation after which two tetrahedra do not overlap: exact, because both are convex and the
/// translations that keep them overlapping form a polytope whose faces belong to a face of one of them (8) or to an
/// edge of each (36). Corners are in any order; flat tetrahedra are allowed.
///
/// Along any axis they are separated by the overlap of their shadows, so an axis with a rounding error, of edges that
/// are almost parallel, gives at most too large a depth: no threshold is needed.
/// units   corners [m]
/// error   some ten roundings of the longest distance of two of the corners
Translation least_translation(const TetrahedronCorners& a, const TetrahedronCorners& b);

}  // namespace dartboard::reference
