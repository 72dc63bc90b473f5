#pragma once
// The check that the cells of a scene can have springs and bending that no edge stands for (section 3.1).

#include <cstdint>
#include <span>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// throws  InputError "FILE: /diagonals: ..." if no cell of springs has such diagonals; "FILE: /bending...: ..." for a
///         solid, and with a rigidity for cells other than triangles and for a surface that is not flat at rest
void require_springs_beside_edges(const SceneFile& scene, const Problem& problem);

/// The stiffness [N/m] of the edges of these cells with a Young's modulus, a mean as in `mean_stiffness`, if the edges
/// share it with diagonals.
double mean_stiffness_beside(const Mesh& mesh, double young, std::span<const std::uint32_t> cells, Diagonals diagonals);

}  // namespace dartboard
