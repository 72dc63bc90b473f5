#pragma once
// The needs of a scene: the one place that decides what is assembled, and what a plan explains.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/plain/diagonals.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/forces/body_force.h"

namespace dartboard {

/// The smallest storage that can hold a mesh. Chains are links, and no map; a mesh of cells of several dimensions is
/// several bodies.
enum class Storage { links, surface, tetrahedra, any_cells, several };
Storage storage_of(const Mesh& mesh);
/// "no map", "2-g-map", "tetrahedral 3-g-map", "3-g-map", "a map for each dimension"
std::string_view map_name(Storage storage);

/// The needs of a body.
struct BodyNeeds {
  Storage storage;
  bool topology_changes;                   // otherwise the map it was built with is freed
  bool viscosity, fixed;                   // a column for it
  bool rest = false;                       // a column of rest positions
  bool pull = false;                       // a column of external forces
  Diagonals diagonals = Diagonals::none;   // springs on those of its cells
  std::vector<ForceNeed> forces{};         // in the order of force_kinds()
  std::vector<SceneObstacle> obstacles{};  // that its boundary may touch
  std::vector<ContactPair> touches{};      // the pairs of its parts that touch: groups are bodies of the scene
  std::vector<std::size_t> first_cell{};   // of each of these bodies, where some touch
  std::vector<std::uint8_t> still{};       // by body: 1 if all of it is held still for the whole run

  /// Does its boundary have any contact?
  bool contact() const { return !obstacles.empty() || !touches.empty(); }
  /// Does contact or some force need rest positions, if only while it is made?
  bool rest_of_forces() const { return contact() || std::ranges::any_of(forces, &ForceNeed::rest); }
};
/// The needs of a problem alone; `needs_of` adds those of the rest of the scene.
BodyNeeds body_needs(const Problem& problem, bool topology_changes);

/// The needs of a scene.
struct Needs {
  BodyNeeds body;
  bool damping, gravity;  // force terms
  bool cell_damping;      // of elements
  bool solver;            // the integrator is implicit: matrices and a factor
  bool refinement;        // some event refines
  bool stress_watch;      // some event needs the stress in every step
};
///
/// throws  InputError as the kinds of force
Needs needs_of(const SceneFile& scene, const Problem& problem);

}  // namespace dartboard
