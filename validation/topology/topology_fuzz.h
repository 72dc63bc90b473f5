#pragma once
// Random operations in lockstep on our maps and on CGAL's, until something differs; then the shortest script for it.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/topology/lockstep.h"

namespace dartboard {

struct FuzzPlan {
  std::string mesh_name;
  ScriptStorage storage = ScriptStorage::general;
  ScriptOracles oracles = ScriptOracles::both;
  std::uint64_t seed = 1;
  std::size_t operations = 1000;
  std::size_t everything_every = 2000;  // operations between two full comparisons; one at the start and the end too
  MakeTwins ours = core_twins;
  std::function<void(std::size_t done)> progress;  // called every 1000 operations or so
};

struct FuzzResult {
  std::size_t applied = 0, illegal = 0, not_carried = 0;
  std::string no_cmap;
  std::optional<Disagreement> disagreement;  // as reproduced by the script
  TopologyScript script;                     // shrunk, when there is a disagreement; empty otherwise
};

/// Random operations. On a disagreement the script is shrunk by delta debugging: every remaining line is necessary.
FuzzResult fuzz_topology(const Mesh& mesh, const FuzzPlan& plan);

/// Apply the operations of a script, and compare everything at the end.
FuzzResult replay_topology(const Mesh& mesh, const TopologyScript& script, const MakeTwins& ours = core_twins);

/// The least number of operations that still disagrees, as far as removing chunks and then single lines finds it.
/// pre  `disagrees(operations)`
std::vector<Operation> shrink(std::vector<Operation> operations,
                              const std::function<bool(const std::vector<Operation>&)>& disagrees);

}  // namespace dartboard
