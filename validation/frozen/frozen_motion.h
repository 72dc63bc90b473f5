#pragma once
// Frozen scenes as plain lists of masses, springs and elements, for the codes of the references.

#include <string>

#include "reference/ode_codes.h"
#include "validation/frozen/frozen_scene.h"

namespace dartboard {

/// The part of a scene that the lists of the references cannot hold, such as "membranes"; else empty.
std::string beyond_references(const SceneFile& file, const Mesh& mesh);

/// [m] Mean length at rest of the edges of the cells, or of the links of a chain; 1 without either.
double mean_edge(const Mesh& mesh);

/// A body at rest in its mesh. Where it is not beyond the references, forces come from its cells, their rest positions
/// and materials alone, by reference/rebuild and reference/elements; else there are masses only.
///
/// The body gives the vertices of each cell, the vertices that are fixed, and the forces applied.
reference::SpringNetwork network_of(const FrozenScene& scene, const SimulatedBody& body);

struct FrozenMotion {
  reference::NetworkMotion motion;
  double fastest_rate = 0.0;  // [1/s] of the body at rest, the largest over time
};
/// The motion of a frozen scene in `checkpoints` equal parts of its duration.
FrozenMotion motion_of(const FrozenScene& scene, std::size_t checkpoints);

}  // namespace dartboard
