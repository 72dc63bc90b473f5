#pragma once
// The bodies that linear solvers are studied on: jittered boxes, whole, and with one vertex dissociated.

#include <cstdint>
#include <vector>

#include "core/time/solve/step_matrix.h"
#include "validation/scenes/extreme_bodies.h"

namespace dartboard {

/// A box of `side`^3 vertices, edges of about 0.1 m, on its map, and the same box with the fan of one interior vertex
/// torn: that vertex, and no other, comes apart into two.
///
/// `stretch` is the strain of a linear field that the positions are moved by; 0 is rest, where every spring has its
/// rest length.
struct DissociationPairs {
  SpringColumns whole;
  std::vector<SpringColumns> torn;  // one vertex more, the others by the same numbers; each from the whole body
};
/// `count` of them, spread over the interior; fewer if there are not as many such vertices.
/// pre     side >= 4
DissociationPairs dissociation_pairs(int side, double stretch, std::size_t count);

/// The matrix of an implicit step at the columns' positions, both forms of it.
struct SolverMatrix {
  StepMatrix step;
  BlockMatrix blocks;
  std::vector<SpringTangent> tangents;
  SolverMatrix(const SpringColumns& columns, Compression compression, double tau);
};

/// Numbers in [-1, 1], the same for equal seeds.
std::vector<Eigen::Vector3d> drawn_vectors(std::size_t count, std::uint64_t seed);

}  // namespace dartboard
