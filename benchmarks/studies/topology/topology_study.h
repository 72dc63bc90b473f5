#pragma once
// `dartboard validate topology`: our map against CGAL's, at rest and through random operations.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// A mesh with a name by which a script can find it again.
struct MeshSource {
  std::string name;
  std::function<Mesh()> make;
};

struct TopologyStudyPlan {
  std::vector<MeshSource> meshes;
  std::size_t operations = 10000;  // random ones, per series
  bool self = false;               // without CGAL during the operations: our storages against each other, and checks
  std::string script_out{};        // file for the script of a disagreement; empty: "disagreement-MESH-SEED.txt"
  std::uint64_t seed = 1;
};

/// throws  IoError for a mesh that no map can be built of
Report topology_study(const TopologyStudyPlan& plan, StudyLog& log);

/// Replays the operations of a script.
///
/// throws  IoError for a script that cannot be read, or whose mesh has changed
Report topology_replay(const std::string& script_file, const std::function<MeshSource(const std::string&)>& find_mesh);

}  // namespace dartboard
