#pragma once
// The points of a scene's mesh that its attachments hold, and where.

#include <vector>

#include "core/elements/attachments.h"
#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The points that one attachment of a scene holds.
struct AttachedPoints {
  double stiffness = 0.0;            // [N/m] of all of them together
  std::vector<Attachment> points{};  // ascending, their shares not set
};

/// Where the attachments of a scene hold the points of its mesh, at rest.
///
/// A point is attached to the cell that it is in or nearest to, of several the first, by weights over the corners of a
/// tetrahedron in it (of a surface a triangle); weights are extrapolated beyond the sides. Cells with more than four
/// corners are split as SkinSolidsView splits them. Flat tetrahedra are left out.
/// throws  InputError "FILE: /attachments/0...: ..." for a selection without vertices, or of those of the target alone;
///         for a point farther away than the longest edge of that cell, or out of the plane of the triangle by more
///         than a millionth of that edge: its spring would have a force at rest
/// cost    O(cells of targets + attached points times their 64th part)
std::vector<AttachedPoints> find_attachments(const SceneFile& scene, const Problem& problem);

/// All of them with the shares of their stiffness, in proportion to the masses of the vertices.
///
/// pre  the vertices are as they were built: one for each point
std::vector<Attachment> shared_by_mass(const std::vector<AttachedPoints>& attached, const VertexColumns& vertices);

}  // namespace dartboard
