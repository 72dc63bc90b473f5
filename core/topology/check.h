#pragma once
// Validity: the three conditions that make darts and alphas a generalized map (section 2.1).

#include <string>

#include "core/topology/generalized_map.h"

namespace dartboard {

/// The first violated condition, in words and numbers; empty for a valid map.
///
/// Conditions: every alpha_i(d) is a live dart; alpha_i is an involution; alpha_i alpha_j is an involution for
/// i + 2 <= j (the condition of quasi-manifolds).
/// cost    O(darts)
template <class Map>
std::string check(const Map& map);

/// What is wrong at one dart.
template <class Map>
std::string check_dart(const Map& map, Dart d);

extern template std::string check(const Map2&);
extern template std::string check(const Map3&);
extern template std::string check(const TetMap&);
extern template std::string check_dart(const Map2&, Dart);
extern template std::string check_dart(const Map3&, Dart);
extern template std::string check_dart(const TetMap&, Dart);

}  // namespace dartboard
