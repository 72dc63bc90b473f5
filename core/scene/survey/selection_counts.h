#pragma once
// The number of vertices or cells in each selection of a scene, counted at rest before anything moves.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The contents of one selection of a body at rest.
struct SelectionCount {
  std::string path;                   // "/fixed/0", "/regions/1/cells", "/events/2/remove"
  std::string_view of_what;           // "vertices", "cells", "faces between cells"
  std::size_t selected = 0, all = 0;  // `selected` of `all`
  std::size_t just_outside = 0;       // not selected, and nearer to its border than `near`
  double near = 0.0;                  // [m] ten times the thickness of borders
  std::string_view along{};  // "x", "y and z": the axes along which vertices are held; empty for other selections
  bool moves = false;        // it is made later, where the body is then
};
/// "/fixed/0: 16 of 44 vertices"
std::string to_string(const SelectionCount& count);

/// The counts of every selection of vertices or cells, in the order of the scene; cuts, which need a map, are not
/// included.
///
/// throws  InputError "/fixed/0/ids/1: ..." for an id that is no point of the mesh
/// cost    O(points + cells) for each
std::vector<SelectionCount> count_selections(const SceneFile& scene, const Mesh& mesh);

/// A sentence if something is just outside the border of a selection; otherwise empty.
std::string near_miss(const SelectionCount& count);

}  // namespace dartboard
