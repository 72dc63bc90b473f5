#pragma once
// The expected effect of its weight on a body that is held or lies on something, before anything moves.

#include <string>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// A body that cannot carry its weight: its height would change by more than itself.
struct Sag {
  std::string path;            // of the body: "/body", "/bodies/1"
  double height = 0.0;         // [m] along gravity
  double strain = 0.0;         // the change of the height over the height
  bool is_as_in_file = false;  // its mesh is from a file and not scaled
};
/// "/body: its weight is expected to compress or stretch it by 98 times its height of 0.1 m; ..."
std::string to_string(const Sag& sag);

/// The bodies whose strain is above 1, of those that are held somewhere or may touch or be attached to something.
///
/// The strain is that of a column that stands or hangs by its own weight: half of density, gravity and height over
/// Young's modulus. Bending, which changes the height of slender bodies further, is not considered; nor are springs
/// without a modulus.
/// cost    O(points + cells)
std::vector<Sag> find_sags(const SceneFile& scene, const Problem& problem);

}  // namespace dartboard
