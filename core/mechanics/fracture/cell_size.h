#pragma once
// The volume or area of a cell as it is now.

#include <Eigen/Core>
#include <span>

#include "core/plain/mesh.h"

namespace dartboard {

/// Volume of a solid cell [m^3], or area of a polygon [m^2], with these corners in the order of a mesh: the measure of
/// `signed_measure`, without its sign. A cell of springs turned inside out has the same lengths, and the same size.
///
/// The bits depend neither on which corner is listed first nor on the side from which a cell is listed: each storage
/// lists the corners of a cell in its own order, and the stress of a body is the same on all of them.
double cell_size(CellKind kind, std::span<const Eigen::Vector3d> corners);

/// The kind of cell that has this number of corners.
/// pre     1 < dimension < 4; 3 or 4 corners of polygons, 4, 5, 6 or 8 of solids
CellKind kind_of_corners(int dimension, std::size_t corners);

}  // namespace dartboard
