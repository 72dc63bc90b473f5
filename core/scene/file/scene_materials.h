#pragma once
// The materials of the cells of a scene.

#include <cstddef>
#include <span>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The place of cell c of a mesh for selections: the mean of its corners [m].
Eigen::Vector3d centroid(const Mesh& mesh, std::size_t c);
std::vector<Eigen::Vector3d> centroids(const Mesh& mesh);

/// The model of the cells of a tissue that have this dimension: the model it names; if it has a 'poisson' and names
/// no model, stable neo-Hookean solids, or membranes of St. Venant and Kirchhoff.
Model model_of(const SceneFile::Tissue& tissue, int dimension);

/// Give the cells of a problem's mesh their materials: that of a region, else of the body, else of the scene. Materials
/// without a cell are left out, and if one is left the body is homogeneous. For springs with a Young's modulus the mean
/// stiffness is taken over their cells (core/base/young.h). Links are cells, too, numbered after the others.
///
/// pre     the problem has its mesh and its bodies
/// throws  InputError "FILE: /regions/0/cells: ..." for a region without a cell, for a model that surfaces do not have,
///         for cells whose edges do not hold their shape
void assign_materials(const SceneFile& scene, Problem& problem);

}  // namespace dartboard
