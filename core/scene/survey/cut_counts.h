#pragma once
// The number of facets that each cut of a scene dissociates in a body at rest.

#include <cstddef>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/survey/selection_counts.h"

namespace dartboard {

/// The number of facets between cells: faces of volumes, edges of polygons.
/// cost  O(cells log cells)
std::size_t count_inner_facets(const Mesh& mesh);

/// The count for a cut that takes apart `selected` facets of `all` between cells; for a bounded cut also the facets on
/// its plane that are just outside its bounds.
///
/// pre   the event's action is Dissociate
/// cost  O(cells log cells) for a bounded cut, else O(points)
SelectionCount count_cut(const SceneEvent& event, const Mesh& mesh, std::size_t selected, std::size_t all);

}  // namespace dartboard
