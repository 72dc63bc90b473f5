#pragma once
// The shares of several threads in the forces of a system: vertices of their own, and the springs and pieces at them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/forces/force_term.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// The share of one thread. It adds, in the order of their numbers, all springs and pieces that have a vertex of its
/// own, and only at these vertices: so every sum has the order and the bits that it has on one thread. What lies
/// between the vertices of two threads is computed by both.
struct ForceShare {
  VertexRange own{};
  std::vector<PieceRun> springs;
  std::vector<std::vector<PieceRun>> pieces;  // by term; none of a term that does not add its forces in parts
};

/// Shares for as many threads as are in use (core/base/thread_team.h), of about the same work; none where the forces of
/// the system take one thread no longer than a few wake-ups of another.
///
/// cost  O(springs + pieces) per thread
std::vector<ForceShare> share_forces(const SpringSystem& system);

/// The bytes of their elements.
std::size_t bytes_of_shares(const std::vector<ForceShare>& shares);

}  // namespace dartboard
