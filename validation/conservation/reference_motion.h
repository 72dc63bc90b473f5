#pragma once
// A body that was taken apart, moved by the reference alone: no map, no core, extended precision.

#include "reference/schemes/extended_motion.h"
#include "validation/conservation/subjects.h"

namespace dartboard {

/// The largest deviation of a body, in spreads of rounding (extended_motion.h): a program rounds some ten times in a
/// step, the spread once, and measured deviations are within one.
inline constexpr double spreads_of_cut_body = 10.0;

/// The remaining cells as a network: a point for each of their vertices, with the sum of its exact shares of mass, a
/// spring for each of their edges, with the stiffness of its cells; and for each point one corner.
struct RemainingNetwork {
  reference::SpringNetwork network;
  std::vector<std::uint32_t> corner;
};
/// pre  no Young's modulus
RemainingNetwork remaining_network(const Problem& start, const RemainingCells& cells);

/// The difference, after some steps of the classical Runge-Kutta method, of the live body from the network of its cells
/// that took the same steps from the same state; and the spread. The body does not change.
struct ReferenceMotion {
  reference::StateBound off, spread;
};
template <class Map>
ReferenceMotion compare_with_reference(const Subject<Map>& at, int steps);

extern template ReferenceMotion compare_with_reference(const Subject<Map2>&, int);
extern template ReferenceMotion compare_with_reference(const Subject<Map3>&, int);
extern template ReferenceMotion compare_with_reference(const Subject<TetMap>&, int);

}  // namespace dartboard
