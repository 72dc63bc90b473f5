#pragma once
// The tasks that `bench topology` times, done by our maps; CGAL's part is validation/cgal/cgal_topology_tasks.h.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/cgal/cgal_topology_tasks.h"

namespace dartboard {

/// The faces to unsew: those between the two sides of an oblique plane through the middle, strip after strip, so that
/// each is a neighbour of the last; and every twentieth face inside the body, drawn at random.
TopologyWork topology_work(Mesh mesh, std::uint64_t seed);

/// The number of units of a figure in one run: darts, vertices, tetrahedra or faces.
double unit_count(std::string_view figure, const TopologyWork& work);

/// The figures of cgal_topology_tasks, and one for which CGAL has no counterpart:
///   local-check   what an operation on a face checks, the darts of both its sides, for work.scattered
///                                                                                finds  the number of valid darts
/// `work` must outlive the tasks.
template <class Map>
std::vector<TopologyTask> topology_tasks(const TopologyWork& work);

/// Bytes of the map of `mesh` and of a number for the vertex and the edge of every dart, nothing in reserve.
template <class Map>
std::size_t map_bytes(const Mesh& mesh);

// ---- everything, prepared to be run

/// One figure, by several contenders on one body, or by the tetrahedral map on bodies of several sizes: they take
/// turns.
struct TopologyGroup {
  struct Entry {
    std::string name;
    double units;  // in one run
    TopologyTask task;
  };
  std::string figure;
  std::vector<Entry> entries;
};

struct TopologyStage {
  std::deque<TopologyWork> works;  // not moved, since the tasks point to them
  std::vector<TopologyGroup> groups;

  void add(const std::string& name, const TopologyWork& work, std::vector<TopologyTask> tasks);
};

inline const std::vector<std::string> topology_bodies{"liver564", "kuhn-48000"};
inline const std::string scaling = "scaling";
inline const std::vector<std::string> scaling_sizes{"2058", "48000", "998250"};

Mesh topology_mesh(const std::string& body);

/// All figures of a body, by "general" (our general storage), "tetrahedral" (ours), "CGAL" and "bare CGAL"; of
/// `scaling`, unsewing in the tetrahedral storage by size.
TopologyStage make_topology_stage(const std::string& body, std::uint64_t seed);

extern template std::vector<TopologyTask> topology_tasks<Map3>(const TopologyWork&);
extern template std::vector<TopologyTask> topology_tasks<TetMap>(const TopologyWork&);
extern template std::size_t map_bytes<Map3>(const Mesh&);
extern template std::size_t map_bytes<TetMap>(const Mesh&);

}  // namespace dartboard
