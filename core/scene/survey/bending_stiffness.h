#pragma once
// The expected error of linear elements in bending, which are too stiff: they lock as Poisson's ratio nears 1/2.

#include <string>
#include <string_view>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Meshes whose elements lock differently.
enum class CellPattern { tetrahedra, mirrored_tetrahedra, pyramids, prisms, hexahedra };
/// "tetrahedra", "mirrored tetrahedra", ...
std::string_view name(CellPattern pattern);

/// The stiffness of a beam of such cells in bending, over the exact one.
///
/// A fit to cantilevers of 2 to 8 cells across and Poisson's ratios from 0.3 to 0.4999
/// (tests/core/scene/survey/bending_stiffness_test.cpp): deflections are within 0.06 of those of the cantilevers.
/// pre  0 <= poisson < 0.5, across >= 1
double bending_stiffness(CellPattern pattern, double poisson, double across);

/// A body that is expected to bend much less than it should.
struct StiffBody {
  std::string path;  // of the body: "/body", "/bodies/1"
  CellPattern pattern;
  double poisson;
  double across;     // cells across the thinnest part
  double stiffness;  // over the exact one
};
/// "/body: tetrahedra at Poisson's ratio 0.49, some 4 across the thinnest part, are expected 3.2 times too stiff in
/// bending ..., take ..."
std::string to_string(const StiffBody& body);

/// The bodies whose elements are expected to be stiffer by a quarter or more, and that are slender or have a Poisson's
/// ratio above 0.4.
///
/// `across` is the smallest extent of a block with the body's principal moments, over the edge of the cube that a cell
/// is a part of. It is a rough figure if a body is thin in one place and thick in another.
/// cost    O(cells)
std::vector<StiffBody> find_stiff_bodies(const SceneFile& scene, const Problem& problem);

}  // namespace dartboard
