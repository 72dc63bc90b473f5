#pragma once
// Orbits: all darts that a set of involutions reaches from one (section 2.1), and coverages of all orbits
// (section 4.2).

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/topology/generalized_map.h"

namespace dartboard {

namespace detail {

// A visitor may return nothing, or true to stop the walk.
template <class F>
bool visit(F& f, Dart d) {
  if constexpr (std::is_void_v<std::invoke_result_t<F&, Dart>>) {
    f(d);
    return false;
  } else {
    return f(d);
  }
}

// The dart that stands for d in the `visited` mark of a walk. General storage marks every dart; tetrahedral storage
// marks one dart per block, so a vertex orbit costs one mark per corner and not six.
template <class Map>
Dart representative(Involutions set, Dart d) {
  if constexpr (Map::tetrahedral) {
    const std::uint32_t p = d.index % 24;
    return {d.index - p + tet_darts.lowest(set.bits & 7u, p)};
  } else {
    return d;
  }
}

/// f(representative) of every block or dart next to the one that `at` represents.
template <class Map, class F>
void leave_block(const Map& map, Involutions set, Dart at, F&& f) {
  if constexpr (Map::tetrahedral) {
    const std::uint32_t t = at.index / 24, p = at.index % 24, within = set.bits & 7u;
    if (!set.contains(3)) return;
    for (std::size_t x = 0; x < tet_darts.exit_count[within]; ++x) {
      const auto [face, r] = tet_darts.exits[within][p][x];
      const std::uint32_t o = map.storage().opposite(4 * t + face);
      f(Dart{24 * (o / 32) + tet_darts.entry[within][r][o % 32]});
    }
  } else {
    for (int i = 0; i <= Map::dimension; ++i) {
      if (!set.contains(i)) continue;
      f(map.alpha(i, at));
    }
  }
}

/// Visit the orbit of d depth first.
///
/// pre  `visited` holds representatives; that of d is among them already.
template <class Map, class F>
bool walk(const Map& map, Involutions set, Dart d, Mark& visited, F&& f) {
  auto& stack = visited.stack();
  const std::size_t bottom = stack.size();
  stack.push_back(representative<Map>(set, d));
  bool stopped = false;
  while (stack.size() > bottom && !stopped) {
    const Dart at = stack.back();
    stack.pop_back();
    if constexpr (Map::tetrahedral) {
      // block by block: `set` is known to the compiler where it matters, so both loops have fixed lengths
      const std::uint32_t t = at.index / 24, p = at.index % 24, within = set.bits & 7u;
      const auto& block = tet_darts.block[within][p];
      for (std::size_t x = 0; x < tet_darts.block_size[within] && !stopped; ++x)
        stopped = visit(f, Dart{24 * t + block[x]});
    } else {
      stopped = visit(f, at);
    }
    leave_block(map, set, at, [&visited, &stack](Dart next) {
      if (visited.set_if_new(next)) stack.push_back(next);
    });
  }
  stack.resize(bottom);
  return stopped;
}

/// Walks an orbit with one visit per representative.
template <class Map, class F>
void walk_places(const Map& map, Involutions set, Dart d, Mark& visited, F&& f) {
  if constexpr (!Map::tetrahedral) {
    walk(map, set, d, visited, f);
  } else {
    auto& stack = visited.stack();
    const std::size_t bottom = stack.size();
    stack.push_back(representative<Map>(set, d));
    while (stack.size() > bottom) {
      const Dart at = stack.back();
      stack.pop_back();
      f(at);
      leave_block(map, set, at, [&visited, &stack](Dart next) {
        if (visited.set_if_new(next)) stack.push_back(next);
      });
    }
  }
}

/// Whether <set>(a) and <set>(b) are one orbit, walking from both in turn: visits at most about twice the smaller one.
template <class Map>
bool meet(const Map& map, Involutions set, Dart a, Dart b) {
  a = representative<Map>(set, a);
  b = representative<Map>(set, b);
  if (a == b) return true;
  Mark mark_a(map), mark_b(map);
  mark_a.set(a);
  mark_b.set(b);
  mark_a.stack().push_back(a);
  mark_b.stack().push_back(b);
  for (Mark *here = &mark_a, *there = &mark_b; !here->stack().empty(); std::swap(here, there)) {
    const Dart at = here->stack().back();
    here->stack().pop_back();
    bool met = false;
    leave_block(map, set, at, [&](Dart next) {
      met = met || (*there)(next);
      if (here->set_if_new(next)) here->stack().push_back(next);
    });
    if (met) return true;
  }
  return false;
}

}  // namespace detail

/// Call f(dart) for every dart of the orbit <set>(d), each once; f may return true to stop. Returns whether it did.
///
/// cost    O(darts of the orbit); no allocation once the map's marks are warm
template <class Map, class F>
bool for_each_dart_of(const Map& map, Involutions set, Dart d, F&& f) {
  Mark visited(map);
  visited.set(detail::representative<Map>(set, d));
  return detail::walk(map, set, d, visited, f);
}

/// The darts of the orbit <set>(d), in the order of the walk.
template <class Map>
std::vector<Dart> orbit(const Map& map, Involutions set, Dart d) {
  std::vector<Dart> darts;
  for_each_dart_of(map, set, d, [&](Dart e) { darts.push_back(e); });
  return darts;
}
/// orbit<0, 1>(map, d) is <alpha_0, alpha_1>(d).
template <int... i, class Map>
std::vector<Dart> orbit(const Map& map, Dart d) {
  return orbit(map, Involutions{i...}, d);
}

/// Whether a walk along the orbit of `a` meets `b`: the paper's isSameOrbit (appendix A).
template <class Map>
bool same_orbit(const Map& map, Involutions set, Dart a, Dart b) {
  return for_each_dart_of(map, set, a, [&](Dart d) { return d == b; });
}

/// A coverage: call f(dart) once for each orbit <set>, with its dart of lowest number, in ascending order.
///
/// cost    O(darts of the map)
template <class Map, class F>
void for_each_orbit(const Map& map, Involutions set, F&& f) {
  Mark covered(map);
  const auto cover = [&](Dart d) {
    if (!covered.set_if_new(d)) return;
    f(d);
    detail::walk(map, set, d, covered, [](Dart) {});
  };
  if constexpr (Map::tetrahedral) {
    const auto end = static_cast<std::uint32_t>(map.capacity());
    for (std::uint32_t first = 0; first < end; first += 24) {
      if (!map.is_live({first})) continue;
      for (std::uint32_t p = 0; p < 24; ++p)
        if (tet_darts.lowest(set.bits & 7u, p) == p) cover({first + p});
    }
  } else {
    map.for_each_dart(cover);
  }
}

template <class Map>
std::size_t count_orbits(const Map& map, Involutions set) {
  std::size_t n = 0;
  for_each_orbit(map, set, [&](Dart) { ++n; });
  return n;
}

}  // namespace dartboard
