#pragma once
// The two orientations of a cell of top dimension, given by the darts within it.

#include <cstdint>

#include "core/topology/generalized_map.h"

namespace dartboard {

namespace detail {

constexpr bool each_involution_changes_parity() {
  for (const auto& alpha : tet_darts.alpha)
    for (unsigned p = 0; p < 24; ++p)
      if (alpha[p] % 2 == p % 2) return false;
  return true;
}

}  // namespace detail

/// Whether `a` and `b`, darts of one cell of top dimension, belong to the same orientation of it: an even number of
/// involutions leads from one to the other. Walked by alpha_0 alpha_1 from either, the faces of a volume then run the
/// same way round, seen from outside.
///
/// pre     the cell is closed and orientable, as the boundary of a ball is; then every path gives the same parity
/// cost    O(darts of the cell); O(1) in a tetrahedron
template <class Map>
bool same_orientation(const Map& map, Dart a, Dart b) {
  if constexpr (Map::tetrahedral) {
    static_assert(detail::each_involution_changes_parity());
    return (a.index + b.index) % 2 == 0;
  } else {
    // Pairs of involutions generate the darts of one orientation: alpha_i alpha_j and back for neighbours i, j is
    // enough. Either b is among them or alpha_0(b).
    const Dart other = map.template alpha<0>(b);
    Mark seen(map);
    seen.set(a);
    auto& stack = seen.stack();
    const std::size_t bottom = stack.size();
    stack.push_back(a);
    bool found = false;
    while (stack.size() > bottom) {
      const Dart at = stack.back();
      stack.pop_back();
      found = at == b;
      if (found || at == other) break;
      for (int i = 0; i + 1 < Map::dimension; ++i)
        for (const Dart next : {map.alpha(i + 1, map.alpha(i, at)), map.alpha(i, map.alpha(i + 1, at))})
          if (seen.set_if_new(next)) stack.push_back(next);
    }
    stack.resize(bottom);
    return found;
  }
}

}  // namespace dartboard
