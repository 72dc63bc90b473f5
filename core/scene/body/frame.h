#pragma once
// One picture of a moving body: what a file of a frame holds.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// The cells of a body where they are now. Points are its vertices by number: the parts of a dissociated vertex are two
/// points.
struct Frame {
  double time = 0.0;  // [s]
  Mesh mesh;
  std::vector<Eigen::Vector3d> velocity;  // [m/s] by point
  std::vector<double> mass;               // [kg] by point
  std::vector<std::uint32_t> mesh_cell;   // by cell: its number in the mesh that the body came from
  std::vector<std::uint32_t> component;   // by cell
  // of a chain, which has no cells: the ends of each link, which files count as a cell of component 0
  std::vector<std::array<std::uint32_t, 2>> links;
};

}  // namespace dartboard
