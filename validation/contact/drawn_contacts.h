#pragma once
// Scenes of contact, drawn as a user may write them: what leaves, slides over seams, or falls on plates of all
// thicknesses; whether any of it is pulled, caught, or lost without a warning.

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace dartboard {

enum class DrawnKind { leaves, slides, drops };
std::string_view name_of(DrawnKind kind);

struct DrawnContact {
  DrawnKind kind{};
  bool with_bodies = false;  // what is touched is a body; otherwise obstacles
  std::string integrator{}, about{};
  double speed = 0.0;                 // [m/s] of what leaves, or of the body
  Eigen::Vector3d velocity{0, 0, 0};  // [m/s] of the body
  double bottom = 0.0;                // [m] of the plate
  nlohmann::ordered_json scene{};
};

/// Scene `number` of a seed; it does not depend on the others. Kinds take turns.
///
/// Boxes of tetrahedra or hexahedra, of springs or elements, balls and sheets; laws of all exponents, restitutions from
/// 0.05 to 1, all integrators. **Leaves**: pressed into a plane, a box or a ball, or into another body, which leaves it
/// within one to 200 steps, in any direction. **Slides**: without friction, over a row of boxes side by side with their
/// tops at one height, or of bodies that are held. **Drops**: on a plate from 0.1 to 100 mm thick, a box or a body, at
/// up to 2 m/s.
DrawnContact draw_contact(std::uint64_t seed, std::uint64_t number);

struct DrawnContactFound {
  bool ended = false;    // regularly; otherwise with a diagnosis
  bool touched = false;  // at some time
  // Leaves: the largest loss of mean speed away from what leaves, over the speed of leaving. Bodies push along their
  // own normals, which turn where they are bent.
  double pulled = 0.0;
  // Slides: over boxes the largest change of the mean speed, over it. Places of a body below push along the normals of
  // the one that slides, so that there it is the largest part across the vertical of a way out for this one's own
  // places, over the depth of the law.
  double caught = 0.0;
  bool lost = false;    // drops: a vertex came out on the other side
  bool warned = false;  // of depth, thickness or speed
};

/// cost  some hundred steps of some hundred vertices
DrawnContactFound run_drawn_contact(const DrawnContact& drawn);

}  // namespace dartboard
