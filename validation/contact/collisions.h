#pragma once
// Collisions by penalty between tetrahedra (section 5.1), of bodies and of the components of one that was split (the
// conclusion).

#include <cstddef>

#include "core/scene/file/scene_file.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Runs a scene whose bodies, or parts of one, run into each other with nothing else acting on them, and looks at it on
/// the way: do they touch, does CGAL find no cells that overlap deeper than the law of contact allows, and is the
/// momentum what it was?
///
/// pre  bodies of tetrahedra, which touch by one law
ClaimAnswer try_collision(const SceneFile& scene, std::size_t looks);

}  // namespace dartboard
