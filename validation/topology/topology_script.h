#pragma once
// Operations on a map as text: the operations of a fuzzer, and the input that reproduces a disagreement.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/storage/dart.h"

namespace dartboard {

/// One line of a script. Darts are named by number: those of the mesh from 0 in the order of its cells, those of an
/// added cell from `a` on; a name is given once. An operation that is illegal when its turn comes is skipped by all
/// maps.
struct Operation {
  enum class Kind : std::uint8_t { sew, unsew, dissociate, remove, add };
  Kind kind = Kind::sew;
  std::int8_t i = 0;                      // of sew and unsew
  CellKind cell = CellKind::tetrahedron;  // of add
  Dart a{};                               // the dart, or the first name of an added cell (none: the next)
  Dart b{};                               // the second dart of sew
  friend bool operator==(const Operation&, const Operation&) = default;
};

/// "sew 3 d17 d40", "unsew 3 d5", "dissociate d5", "remove d3", "add tetrahedron d144"
std::string to_string(const Operation& operation);

/// The maps of ours that take part: Map2 or Map3 alone, or Map3 and TetMap in lockstep.
enum class ScriptStorage : std::uint8_t { general, tetrahedral };
/// The twins of CGAL's that take part: none, the generalized map, or the combinatorial map too (and then no operation
/// that it cannot carry).
enum class ScriptOracles : std::uint8_t { none, gmap, both };

std::string_view name(ScriptStorage storage);
std::string_view name(ScriptOracles oracles);

struct TopologyScript {
  std::string mesh;  // a name or a file; it is resolved by the caller that replays it
  ScriptStorage storage = ScriptStorage::general;
  ScriptOracles oracles = ScriptOracles::both;
  std::vector<Operation> operations;
};

/// The first four lines are: dartboard-topology-script 1, mesh NAME, storage general|tetrahedral, oracles
/// none|gmap|both. Then one operation a line; # starts a comment.
std::string to_string(const TopologyScript& script);

/// `add` may leave out its first name: the darts are then named from the smallest number above all names so far.
/// throws  IoError that names `file`, the line and what was expected
TopologyScript parse_topology_script(std::string_view text, const std::string& file);

/// throws  IoError
TopologyScript read_topology_script(const std::filesystem::path& path);
/// throws  IoError when the file cannot be written
void write_topology_script(const std::filesystem::path& path, const TopologyScript& script);

}  // namespace dartboard
