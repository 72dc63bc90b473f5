#include "core/operations/dissociate_face.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"

namespace dartboard {
namespace {

/// A dart of the dissociated side and the one it was sewn to: appendix A's da and db.
struct Pair {
  Dart a, b;
};
using Pairs = boost::container::small_vector<Pair, 8>;  // a quadrilateral has 8 darts

template <int i, class Map>
Pairs unsew_pairs(Map& map, Dart d) {
  Pairs pairs;
  detail::for_each_on_line<i>(map, d, [&](Dart a) { pairs.push_back({a, map.template alpha<i>(a)}); });
  unsew<i>(map, d);
  // A face that was folded onto itself lists each pair from both ends: keep one, so that no cell is tested twice.
  if (std::any_of(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.a == pairs[0].b; }))
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.b < p.a; }), pairs.end());
  return pairs;
}

/// The dart of the same end of the same edge at the far side of the fan of volumes that starts at `a`, which is 3-free.
/// The fan is a path then, so no marks are needed.
template <class Map>
Dart far_side(const Map& map, Dart a) {
  for (Dart x = a;;) {
    const Dart y = map.template alpha<2>(x);
    const Dart z = map.template alpha<3>(y);
    if (y == x || z == y) return y;
    x = z;
  }
}

template <class Map>
void check_touched(const Map& map, const Pairs& pairs) {
  for (const Pair& p : pairs)
    for (const Dart d : {p.a, p.b})
      if (const auto violation = check_dart(map, d); !violation.empty()) throw_invalid("a dissociation", violation);
}

}  // namespace

template <class Map>
TopologyChange dissociate_face(Map& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  if (map.template is_free<3>(d)) return change;
  const Dart opposite = map.template alpha<3>(d);
  const Pairs pairs = unsew_pairs<3>(map, d);
  check_touched(map, pairs);
  if (!same_orbit(map, {0, 1}, d, opposite)) change.faces.push_back({d, opposite});

  // Edges first: each is met by its two darts on the face, and tested from the one with the lower number.
  const auto find = [&](Dart x) {
    return static_cast<std::size_t>(std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.a == x; }) -
                                    pairs.begin());
  };
  boost::container::small_vector<bool, 8> joined(pairs.size(), false);  // at this end, through the fan of its edge
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    const std::size_t twin = find(map.template alpha<0>(a));
    if (twin < k) {
      joined[k] = joined[twin];
      continue;
    }
    const Dart far = far_side(map, a);
    joined[k] = far == b;
    // alpha_0 commutes with the steps along the fan: a fan with a twist ends at the other end of the opposite edge
    if (far != b && map.template alpha<0>(far) != b) change.edges.push_back({a, b});
  }
  // A vertex can only come apart where both of its edges on the face did: one that still joins the two sides joins their
  // corners too.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    const std::size_t twin = find(map.template alpha<1>(a));
    if (twin < k || joined[k] || (twin < pairs.size() && joined[twin])) continue;
    if (!same_cell<0>(map, a, b)) change.vertices.push_back({a, b});
  }
  return change;
}

template <class Map>
TopologyChange dissociate_face_by_orbits(Map& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  if (map.template is_free<3>(d)) return change;
  const Dart opposite = map.template alpha<3>(d);
  const Pairs pairs = unsew_pairs<3>(map, d);
  if (!same_cell<2>(map, d, opposite)) change.faces.push_back({d, opposite});
  const auto first_of = [&](std::size_t k, Dart twin) {  // not met before by its twin on the same cell
    return std::none_of(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(k), [&](const Pair& p) { return p.a == twin; });
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    if (first_of(k, map.template alpha<0>(a)) && !same_cell<1>(map, a, b)) change.edges.push_back({a, b});
    if (first_of(k, map.template alpha<1>(a)) && !same_cell<0>(map, a, b)) change.vertices.push_back({a, b});
  }
  return change;
}

TopologyChange dissociate_edge(Map2& map, Dart d) {
  map.require_live(d);
  TopologyChange change;
  if (map.is_free<2>(d)) return change;
  const Dart opposite = map.alpha<2>(d);
  const Pairs pairs = unsew_pairs<2>(map, d);
  check_touched(map, pairs);
  if (!same_cell<1>(map, d, opposite)) change.edges.push_back({d, opposite});
  for (const auto& [a, b] : pairs)
    if (!same_cell<0>(map, a, b)) change.vertices.push_back({a, b});
  return change;
}

template TopologyChange dissociate_face(Map3&, Dart);
template TopologyChange dissociate_face(TetMap&, Dart);
template TopologyChange dissociate_face_by_orbits(Map3&, Dart);
template TopologyChange dissociate_face_by_orbits(TetMap&, Dart);

}  // namespace dartboard
