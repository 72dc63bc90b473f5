#pragma once
// Sewing and unsewing: link and unlink for all the darts that must go together, so that a map stays a map.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/topology/generalized_map.h"

namespace dartboard {

namespace detail {

// An i-sew acts on the orbit of {alpha_j : |i - j| >= 2}. In dimension 2 and 3 these are at most two involutions, so
// the orbit is a path or a cycle of darts, and two of them can be followed side by side without marks.
template <int i, class Map>
struct SewLine {
  static constexpr Involutions set = sew_involutions(Map::dimension, i);
  static_assert(set.size() <= 2);
  static constexpr int first = set.size() == 0 ? -1 : std::countr_zero(set.bits);
  static constexpr int second = set.size() < 2 ? -1 : 7 - std::countl_zero(set.bits);

  /// The next dart from d, alternating the two involutions; d itself at the end of a path.
  static Dart next(const Map& map, Dart d, bool use_second) {
    const int j = use_second ? second : first;
    return j < 0 ? d : map.alpha(j, d);
  }
};

/// Call f(dart) for every dart of the line of d, d first; f may change alpha_i.
template <int i, class Map, class F>
void for_each_on_line(const Map& map, Dart d, F&& f) {
  f(d);
  bool closed = false;
  for (const bool start : {false, true}) {
    Dart x = d;
    for (bool step = start; !closed; step = !step) {
      const Dart next = SewLine<i, Map>::next(map, x, step);
      if (next == x) break;  // the end of a path, which may be d itself
      closed = next == d;
      if (closed) break;
      f(x = next);
    }
  }
}

/// Pair the darts of the two lines through a and b; an explanation if they do not correspond.
template <int i, class Map>
std::string pair_lines(const Map& map, Dart a, Dart b, std::vector<std::pair<Dart, Dart>>& pairs) {
  using Line = SewLine<i, Map>;
  pairs.assign(1, {a, b});
  bool closed = false;
  for (const bool start : {false, true}) {  // away from a by one involution, then by the other
    if (closed) break;
    Dart x = a, y = b;
    for (bool step = start;; step = !step) {
      const Dart x_next = Line::next(map, x, step), y_next = Line::next(map, y, step);
      const bool x_ends = x_next == x, y_ends = y_next == y;
      if (x_ends != y_ends) return "the cells do not have the same structure (one line of darts ends before the other)";
      if (x_ends) break;
      x = x_next;
      y = y_next;
      closed = x == a && step != start;  // back at a by the other involution: a cycle
      if (closed != (y == b && step != start)) return "the cells do not have the same number of darts";
      if (closed) break;
      pairs.push_back({x, y});
    }
  }
  return {};
}

}  // namespace detail

/// The reason why the cells of `a` and `b` cannot be i-sewn, or no value when they can.
///
/// `pairs`, if given, receives the darts to link.
template <int i, class Map>
std::optional<std::string> why_not_sewable(const Map& map, Dart a, Dart b,
                                           std::vector<std::pair<Dart, Dart>>* pairs = nullptr) {
  std::vector<std::pair<Dart, Dart>> own;
  auto& found = pairs ? *pairs : own;
  if (!map.is_live(a) || !map.is_live(b)) return to_string(map.is_live(a) ? b : a) + " is dead";
  if (a == b) return "a dart cannot be sewn to itself";
  if (auto why = detail::pair_lines<i>(map, a, b, found); !why.empty()) return why;
  for (const auto& [x, y] : found) {
    for (const Dart d : {x, y})
      if (!map.template is_free<i>(d))
        return "alpha" + std::to_string(i) + "(" + to_string(d) + ") = " + to_string(map.template alpha<i>(d)) +
               ", expected free";
    // Both on the same line: pairing must be an involution. One dart decides, because it commutes with the walk.
    if (x == b && y != a)
      return to_string(a) + " and " + to_string(b) + " lie on one cell, and folding it so would pair " + to_string(b) +
             " with " + to_string(y);
  }
  return std::nullopt;
}

/// i-sew the cells of `a` and `b` so that alpha_i(a) = b.
///
/// throws  TopologyError when the two cells do not correspond or are not i-free; the map is unchanged then
/// cost    O(darts of the two cells)
template <int i, class Map>
void sew(Map& map, Dart a, Dart b) {
  std::vector<std::pair<Dart, Dart>> pairs;
  if (const auto why = why_not_sewable<i>(map, a, b, &pairs)) throw_not_sewable(i, a, b, *why);
  for (const auto& [x, y] : pairs)
    if (map.template is_free<i>(x)) map.template link<i>(x, y);  // a folded cell, or a whole face, has been linked
}

/// Undo an i-sew: all darts of the line of `d` become i-free. Nothing happens when `d` is i-free.
///
/// throws  TopologyError if d is dead
/// cost    O(darts of the cell)
template <int i, class Map>
void unsew(Map& map, Dart d) {
  map.require_live(d);
  if (map.template is_free<i>(d)) return;
  if constexpr (Map::tetrahedral)
    map.template unlink<i>(d);  // the whole face goes with it
  else
    detail::for_each_on_line<i>(map, d, [&](Dart x) { map.template unlink<i>(x); });
}

}  // namespace dartboard
