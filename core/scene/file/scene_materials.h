#pragma once
// What the cells of a scene are made of.

#include <cstddef>
#include <span>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Where a selection takes cell c of a mesh to be: the mean of its corners [m].
Eigen::Vector3d centroid(const Mesh& mesh, std::size_t c);
std::vector<Eigen::Vector3d> centroids(const Mesh& mesh);

/// What the cells of a tissue are modelled by, in a mesh of this dimension: what it names; where it has a 'poisson' and
/// names nothing, stable neo-Hookean solids, or membranes of St. Venant and Kirchhoff.
Model model_of(const SceneFile::Tissue& tissue, int dimension);

/// Give a problem that has its mesh the materials of its cells: that of the scene, of a body over it, of regions over
/// that. Materials of no cell are left out, and with one left the body is homogeneous. Of springs with a Young's
/// modulus the mean stiffness is taken over their cells (core/plain/young.h).
///
/// units   first_cell: of each body, the number of its first cell
/// throws  InputError "FILE: /regions/0/cells: ..." for a region of no cell, for a surface of a model that it does not
///         have, for cells whose edges do not hold their shape
void assign_materials(const SceneFile& scene, std::span<const std::size_t> first_cell, Problem& problem);

}  // namespace dartboard
