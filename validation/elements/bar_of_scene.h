#pragma once
// The clamped bar of a scene file.

#include "core/scene/file/scene_file.h"
#include "validation/elements/clamped_bar.h"

namespace dartboard {

struct BarOfScene {
  ClampedBar bar;
  double poisson = 0.25;               // of the scene's elements; 1/4 of springs
  std::vector<std::string> omissions;  // of the scene, each in a sentence
};

/// The box of a scene, its material and which end is held; turned so that it lies along x. The coarsest mesh has the
/// largest cubes that the scene's numbers of cells allow.
///
/// throws  InputError "FILE: /key: what it is; expected ..." for a body that is no generated box, a material without
///         Young's modulus, driven vertices, fixed points other than all of one end, and as make_problem
BarOfScene bar_of_scene(const SceneFile& scene);

}  // namespace dartboard
