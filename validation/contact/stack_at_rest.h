#pragma once
// A stack of boxes that falls, comes to rest, and is watched there.

#include <cstddef>
#include <cstdint>

namespace dartboard {

struct StackAtRest {
  std::size_t boxes = 0;
  std::uint64_t steps = 0;  // that it is watched for
  double drop = 0.0;        // [J] of potential energy, from the start until it is watched
  double kinetic = 0.0;     // [J] the most while it is watched
  double moved = 0.0;       // the largest way of a vertex meanwhile, over the edge of a cell
  bool ended = false;       // regularly
};

/// Five boxes of 10 cm and 1 kg, of tetrahedra and of hexahedra in turn, each a little aside and 2 mm above the one
/// below, with restitution and friction. They are soft enough to be pressed together by their weight, and not so soft
/// that a column of their height would buckle under its own, as half of their modulus would do (Greenhill 1881).
///
/// cost  22,000 steps of Verlet, some seconds
StackAtRest watch_stack();

}  // namespace dartboard
