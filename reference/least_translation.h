#pragma once
// How deep two tetrahedra are in each other, by separating axes.

#include <Eigen/Core>
#include <array>

namespace dartboard::reference {

using TetrahedronCorners = std::array<Eigen::Vector3d, 4>;

/// What parts two tetrahedra: the second one moved by depth times along.
struct Translation {
  double depth = 0.0;              // [m]; below 0 where they are apart, by no more than their distance
  Eigen::Vector3d along{0, 0, 0};  // of length 1; 0 where both are points
};

/// The shortest translation after which two tetrahedra do not overlap: exact, as both are convex and what leaves them
/// overlapping is a polytope of translations, whose faces belong to a face of one of them (8) or to an edge of each
/// (36). Corners are in any order; flat ones are as good as others.
///
/// Along any axis at all they are parted by what their shadows share, so an axis that is off by rounding, of edges that
/// are almost parallel, is too deep at most: no threshold is needed.
/// units   corners [m]
/// error   some ten roundings of the longest distance of two of the corners
Translation least_translation(const TetrahedronCorners& a, const TetrahedronCorners& b);

}  // namespace dartboard::reference
