#pragma once
// The rebuild oracle: a body that was taken apart moves as one built from scratch from the cells that remain.

#include <cstddef>

#include "reference/summation_bound.h"
#include "validation/conservation/subjects.h"

namespace dartboard {

/// The differences of the live body from bodies built from scratch, after some steps from the same state.
struct RebuiltMotion {
  // build_body of the rest_problem. Where an edge came apart between vertices that did not, the live body has several
  // springs between the same vertices and this one has their sum: another order of summation, compared within a bound.
  double position = 0.0, velocity = 0.0;  // largest difference of a coordinate [m], [m/s]
  reference::StateBound bound{};
  std::size_t springs_side_by_side = 0;

  // The same, and then all sides that touch but are not joined are dissociated in one series. It has exactly the live
  // body's cells, so with its edges walked in the live body's order the bits must agree.
  std::size_t vertices = 0, springs = 0;
  bool same_cells = false, same_bits = false;
};

template <class Map>
RebuiltMotion compare_rebuilt_motion(const Subject<Map>& at, int steps);

extern template RebuiltMotion compare_rebuilt_motion(const Subject<Map2>&, int);
extern template RebuiltMotion compare_rebuilt_motion(const Subject<Map3>&, int);
extern template RebuiltMotion compare_rebuilt_motion(const Subject<TetMap>&, int);

}  // namespace dartboard
