#pragma once
// From one representation to another: tetrahedral to general storage, and generalized to combinatorial maps.

#include <array>
#include <cstdint>
#include <vector>

#include "core/topology/generalized_map.h"

namespace dartboard {

/// A copy of the map in general storage, dart for dart under the same numbers (dead ones too, whose slots are used
/// again in another order). For a tetrahedral map when an operation needs other cells.
///
/// cost    O(darts)
Map3 to_general(const TetMap& map);

/// An n-dimensional combinatorial map: half the darts, oriented. beta_1 is a permutation, beta_2 .. beta_n involutions,
/// and a free dart has `none` as its image [Lie91].
struct CombinatorialMap {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  int dimension = 0;
  std::vector<std::array<std::uint32_t, 3>> beta;  // beta[d][i - 1]
};

/// One dart for each dart of one orientation: beta_1 = alpha_1 after alpha_0, and beta_i = alpha_i after alpha_0.
///
/// throws  InputError if the map is not orientable, or a dart is 0- or 1-free, which a combinatorial map cannot express
template <class Map>
CombinatorialMap to_combinatorial_map(const Map& map);

/// Two darts for each dart d: 2d, and 2d + 1 as its alpha_0.
template <int n>
GeneralizedMap<n> to_generalized_map(const CombinatorialMap& map);

/// Whether some one-to-one correspondence of darts respects every alpha_i.
///
/// cost    O(darts) per component in the common case, O(darts^2) for maps full of symmetries
template <class A, class B>
bool are_isomorphic(const A& a, const B& b);

#define DARTBOARD_CONVERT(prefix)                                       \
  prefix template CombinatorialMap to_combinatorial_map(const Map2&);   \
  prefix template CombinatorialMap to_combinatorial_map(const Map3&);   \
  prefix template CombinatorialMap to_combinatorial_map(const TetMap&); \
  prefix template Map2 to_generalized_map<2>(const CombinatorialMap&);  \
  prefix template Map3 to_generalized_map<3>(const CombinatorialMap&);  \
  prefix template bool are_isomorphic(const Map2&, const Map2&);        \
  prefix template bool are_isomorphic(const Map3&, const Map3&);        \
  prefix template bool are_isomorphic(const TetMap&, const Map3&);      \
  prefix template bool are_isomorphic(const TetMap&, const TetMap&);
DARTBOARD_CONVERT(extern)

}  // namespace dartboard
