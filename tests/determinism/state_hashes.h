#pragma once
// Runs that must end in the same bits everywhere, each with the hash that it ends in.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace dartboard {

/// A body that moves, most of them while they are cut, torn, eroded or refined; the hash is of all that its motion
/// depends on: positions, velocities, masses, springs and their ends.
struct HashedRun {
  std::string name;
  std::function<std::uint64_t()> run;
  // What it ends in. It changes only when the run or the order of its sums does: say so in the commit.
  std::uint64_t pinned;
};

/// On generated meshes and on the paper's body; all integrators; both storages. Their hashes are equal where no cell
/// goes away and none is added: the numbers that cells get then depend on the storage.
std::span<const HashedRun> hashed_runs();

/// Implicit integration with a supernodal factor, whose bits are those of the BLAS: nothing is pinned.
std::uint64_t hash_with_supernodal_factor();

}  // namespace dartboard
