#pragma once
// The work timed by `bench topology`, done by CGAL's generalized map through its own interface.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/storage/dart.h"

namespace dartboard {

/// The input of every contender. Darts go by their numbers in our maps: 24 c + p is dart p of tetrahedron c.
struct TopologyWork {
  Mesh mesh;                         // of tetrahedra
  std::vector<Dart> vertices;        // a dart of each vertex
  std::vector<Dart> cut, scattered;  // a dart of each face to unsew: neighbours along a cut, and here and there
};

/// One figure of one contender. All contenders must find the same number, or they did not do the same work.
struct TopologyTask {
  std::string figure;                  // "vertex-orbit"
  std::function<std::uint64_t()> run;  // returns its result
  std::function<void()> restore;       // puts the map back and reads it through, to fill the caches with it
};

/// The figures
///   vertex-orbit          all darts of all vertices                              finds  the number of darts
///   vertex-to-tetrahedra  the tetrahedra around each vertex                      finds  the number of incidences
///   full-check            validity of the whole map                              finds  1 for valid
///   count-cells           vertices, edges, faces and volumes                     finds  their sum
///   build                 from the mesh                                          finds  the number of darts
/// unsew-cut             3-unsew work.cut, reporting vertices and edges that    finds  the number of both that came
///   unsew-scattered       come apart; the same for work.scattered                       apart
/// as CGAL does them. `work` must outlive the tasks.
///
/// The map has a numbered attribute on each vertex and edge. Their split functors report what an unsew dissociates, the
/// only way in CGAL; is_valid() checks them too, and so does `build` (vertices only, like ours).
std::vector<TopologyTask> cgal_topology_tasks(const TopologyWork& work);

/// Tasks without attributes: smaller darts and less to check. They cannot report what an unsew dissociates.
std::vector<TopologyTask> cgal_bare_topology_tasks(const TopologyWork& work);

/// The heap memory of the map of `mesh` with a numbered attribute on each vertex and edge.
std::size_t cgal_map_bytes(const Mesh& mesh);

}  // namespace dartboard
