#pragma once
// Frozen scenes as plain lists of masses, springs and elements, for the codes of the references.

#include <string>

#include "reference/ode_codes.h"
#include "validation/frozen/frozen_scene.h"

namespace dartboard {

/// What no list of the references holds, such as "membranes", of a scene that has it; else empty.
std::string beyond_references(const SceneFile& file, const Mesh& mesh);

/// [m] Mean length of the edges of cells at rest, of a chain that of its links; 1 where there are none.
double mean_edge(const Mesh& mesh);

/// A body at rest in its mesh. Where it is not beyond the references, forces come from its cells, their rest places and
/// materials alone, by reference/rebuild and reference/elements; else there are masses only.
///
/// From the body come the vertices of each cell, which of them are fixed, and what pulls at them.
reference::SpringNetwork network_of(const FrozenScene& scene, const SimulatedBody& body);

struct FrozenMotion {
  reference::NetworkMotion motion;
  double fastest_rate = 0.0;  // [1/s] of the body at rest, the largest over time
};
/// The motion of a frozen scene in `checkpoints` equal parts of its duration.
FrozenMotion motion_of(const FrozenScene& scene, std::size_t checkpoints);

}  // namespace dartboard
