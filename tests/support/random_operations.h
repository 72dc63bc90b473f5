#pragma once
// Random operations until nothing is left, for tests of data that must follow them.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/operations/dissociate_face.h"
#include "core/operations/remove_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/random.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard {

template <class Map>
using AdaptedBody = MassSpringBody<Map, Held::by_every_dart>;

/// A body of this mesh with a material in whole numbers.
template <class Map>
AdaptedBody<Map> body_of(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material = {.density = 1000.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  return build_body<Map, Held::by_every_dart>(problem);
}

/// The same body, with its places at rest.
template <class Map>
AdaptedBody<Map> at_rest(const Mesh& mesh) {
  auto body = body_of<Map>(mesh);
  body.vertices.keep_rest();
  return body;
}

/// The first three nodes of every other cell in another order: those cells are left-handed, the solid is the same.
inline Mesh with_left_handed_cells(Mesh mesh) {
  for (std::size_t c = 0; c < mesh.cell_count(); c += 2)
    std::swap(mesh.nodes[mesh.first[c]], mesh.nodes[mesh.first[c] + 1]);
  return mesh;
}

/// A sheet, a strip of one side, a bottle and a torus, their points on a twisted cubic: no two chords of it are
/// parallel, so no face has area zero, however its points are joined.
inline std::vector<Mesh> surfaces() {
  std::vector<Mesh> meshes{quadrilateral_grid(4, 3), moebius_lattice(), klein_lattice(), torus_lattice()};
  for (Mesh& mesh : meshes)
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      const double t = 0.125 * static_cast<double>(k);
      mesh.points[k] = {t, t * t, t * t * t};
    }
  return meshes;
}

template <class Map>
Dart some_live_dart(const Map& map, SplitMix64& random) {
  for (;;)
    if (const Dart d{random.below(map.capacity())}; map.is_live(d)) return d;
}

/// A dissociation.
template <class Map>
TopologyChange dissociate_something(Map& map, SplitMix64& random) {
  if constexpr (Map::dimension == 2)
    return dissociate_edge(map, some_live_dart(map, random));
  else
    return dissociate_face(map, some_live_dart(map, random));
}

/// A cell of top dimension goes away.
template <class Map>
TopologyChange remove_something(Map& map, SplitMix64& random) {
  if constexpr (Map::dimension == 2)
    return remove_face(map, some_live_dart(map, random));
  else
    return remove_volume(map, some_live_dart(map, random));
}

/// Applies a dissociation, a torn fan (of a solid), a removal, or a series of them, to a body that is not empty.
template <class Map>
TopologyChange do_something(Map& map, SplitMix64& random) {
  const auto tear_something = [&map, &random] {
    if constexpr (Map::dimension == 2)
      return dissociate_something(map, random);
    else
      return tear_fan(map, some_live_dart(map, random));
  };
  const std::uint32_t what = random.below(8);
  if (what < 4) return dissociate_something(map, random);
  if (what == 4) return tear_something();
  if (what < 7) return remove_something(map, random);
  TopologyChange change = tear_something();
  change.append(remove_something(map, random));
  if (map.dart_count() > 0) change.append(dissociate_something(map, random));
  if (map.dart_count() > 0) change.append(remove_something(map, random));
  return change;
}

/// Calls follow(body, change, changed) after each of many random operations, until nothing is left of the body.
template <class Map, class Follow>
void operate_at_random(AdaptedBody<Map>& body, std::uint64_t seed, int dissociations_first, Follow&& follow) {
  SplitMix64 random(seed);
  const auto adapt_and_follow = [&](const TopologyChange& change) {
    const ChangedEmbeddings changed = adapt(body, change);
    follow(body, change, changed);
  };
  for (int k = 0; k < dissociations_first; ++k) adapt_and_follow(dissociate_something(body.map, random));
  while (body.map.dart_count() > 0) adapt_and_follow(do_something(body.map, random));
}

/// A view that has followed many random operations, until nothing was left of the body; expect(view, body) after each.
template <class View, class Map, class Expect>
View followed_until_nothing_is_left(AdaptedBody<Map> body, std::uint64_t seed, int dissociations_first,
                                    Expect&& expect) {
  View view;
  view.rebuild(body);
  operate_at_random(body, seed, dissociations_first,
                    [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
                      view.apply(now, changed);
                      expect(view, now);
                    });
  return view;
}

}  // namespace dartboard
