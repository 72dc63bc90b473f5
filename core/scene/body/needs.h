#pragma once
// What a scene requires: the one place that decides what is assembled, and what a plan explains.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/plain/diagonals.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The smallest storage that can hold a mesh. Points without cells are a chain in their order: links, and no map.
enum class Storage { links, surface, tetrahedra, any_cells };
Storage storage_of(const Mesh& mesh);
/// "no map", "2-g-map", "tetrahedral 3-g-map", "3-g-map"
std::string_view map_name(Storage storage);

/// What a body must have.
struct BodyNeeds {
  Storage storage;
  bool topology_changes;                   // else the map it was built with is let go
  bool viscosity, fixed;                   // a column for it
  bool rest = false;                       // a column of places at rest
  bool pull = false;                       // a column of forces from outside
  Diagonals diagonals = Diagonals::none;   // springs on those of its cells
  Bending bending{};                       // of a surface
  std::vector<SceneObstacle> obstacles{};  // that its boundary feels
  std::vector<ContactPair> touches{};      // its parts that do: groups are bodies of the scene
  std::vector<std::size_t> first_cell{};   // of each of these bodies, where some touch

  /// Does its boundary feel anything?
  bool contact() const { return !obstacles.empty() || !touches.empty(); }
};
/// What a problem asks for itself; what else a scene does is in `needs_of`.
BodyNeeds body_needs(const Problem& problem, bool topology_changes);

/// What a scene must have.
struct Needs {
  BodyNeeds body;
  bool damping, gravity;  // force terms
  bool cell_damping;      // of elements
  bool solver;            // the integrator is implicit: matrices and a factor
  bool refinement;        // some event refines
  bool stress_watch;      // some event looks at the stress in every step
};
Needs needs_of(const SceneFile& scene, const Problem& problem);

}  // namespace dartboard
