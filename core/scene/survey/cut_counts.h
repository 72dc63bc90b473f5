#pragma once
// How much of a body at rest each cut of a scene takes apart.

#include <cstddef>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/survey/selection_counts.h"

namespace dartboard {

/// Of a cut that takes `selected` facets apart, of `all` between cells; a bounded one names those on its plane that are
/// just outside its bounds.
///
/// pre   the event's action is Dissociate
/// cost  O(cells log cells) for a bounded cut, else O(points)
SelectionCount count_cut(const SceneEvent& event, const Mesh& mesh, std::size_t selected, std::size_t all);

}  // namespace dartboard
