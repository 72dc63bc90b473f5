#pragma once
// Runs that must end in the same bits everywhere, each with the hash of its end.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace dartboard {

/// A moving body, in most runs cut, torn, eroded or refined while it moves; the hash is of everything that the motion
/// depends on: positions, velocities, masses, springs and their ends.
struct HashedRun {
  std::string name;
  std::function<std::uint64_t()> run;
  // The hash of the end. It changes only when the run or the order of its sums does: say so in the commit.
  std::uint64_t pinned;
};

/// On generated meshes and on the paper's body; all integrators; both storages. Hashes of both storages are equal where
/// no cell is removed or added: otherwise the numbers of cells depend on the storage.
std::span<const HashedRun> hashed_runs();

/// Implicit integration with a supernodal factor, whose bits are those of the BLAS: nothing is pinned.
std::uint64_t hash_with_supernodal_factor();

}  // namespace dartboard
