#include "validation/paper/maps/orbits_come_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/operations/dissociate_face.h"
#include "core/plain/random.h"
#include "validation/paper/maps/dart_table_of.h"

namespace dartboard {
namespace {

using Labels = std::vector<std::uint32_t>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // of orbits, the lower first

template <class Map>
Labels cells(const reference::DartTable& table, int i) {
  if constexpr (Map::dimension == 2)
    return i == 0 ? orbits(table, {1, 2}) : orbits(table, {0, 2});
  else
    return i == 0 ? orbits(table, {1, 2, 3}) : orbits(table, {0, 2, 3});
}

/// The orbits separated by the unsewn darts: each pair once.
Pairs parted(const Labels& orbit, const Pairs& darts) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> apart;
  for (const auto& [a, b] : darts)
    if (orbit[a] != orbit[b]) apart.insert(std::minmax(orbit[a], orbit[b]));
  return {apart.begin(), apart.end()};
}

/// The reported pairs, in the same form; a pair that is reported twice is in it twice.
Pairs reported(const Labels& orbit, const std::vector<DissociatedCell>& cells) {
  Pairs pairs;
  for (const auto& [kept, split] : cells) pairs.push_back(std::minmax(orbit[kept.index], orbit[split.index]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

template <class Map>
ClaimAnswer try_orbits(const Map& at_rest, int dissociations, std::uint64_t seed,
                       const DissociateFacet<Map>& dissociate) {
  constexpr int n = Map::dimension;
  Map map = at_rest;
  SplitMix64 random(seed);
  std::size_t asked = 0, vertices = 0, edges = 0;
  for (int k = 0; k < dissociations; ++k) {
    const auto before = dart_table_of(map);
    // a sewn dart, and all that will be unsewn with it
    const auto from = random.below(static_cast<std::uint32_t>(before.size()));
    std::uint32_t d = from;
    while (!before.is_live(d) || before(n, d) == d)
      if (d = (d + 1) % static_cast<std::uint32_t>(before.size()); d == from) break;
    if (!before.is_live(d) || before(n, d) == d) break;
    const Labels facet = n == 2 ? orbits(before, {0}) : orbits(before, {0, 1});
    Pairs unsewn;
    for (std::uint32_t e = 0; e < before.size(); ++e)
      if (before.is_live(e) && facet[e] == facet[d]) unsewn.emplace_back(e, before(n, e));

    const TopologyChange change = dissociate(map, Dart{d});

    const auto after = dart_table_of(map);
    const Labels vertex = cells<Map>(after, 0), edge = cells<Map>(after, 1);
    const Pairs vertices_apart = parted(vertex, unsewn), edges_apart = parted(edge, unsewn);
    asked += n == 2 ? 2 : unsewn.size() / 2;
    vertices += vertices_apart.size();
    edges += edges_apart.size();
    if (reported(vertex, change.vertices) != vertices_apart || reported(edge, change.edges) != edges_apart)
      return {false,
              fmt::format("dissociation {}: {} vertices and {} edges are reported, {} and {} orbits came apart", k,
                          change.vertices.size(), change.edges.size(), vertices_apart.size(), edges_apart.size())};
  }
  const bool both = vertices > 0 && vertices < asked && (n == 2 || (edges > 0 && edges < asked));
  return {both, fmt::format("of {} corners {} came apart, and {} edges: as reported", asked, vertices, edges)};
}

template <class Map>
ClaimAnswer try_orbits(const Map& at_rest, int dissociations, std::uint64_t seed) {
  return try_orbits<Map>(at_rest, dissociations, seed, [](Map& map, Dart d) {
    if constexpr (Map::dimension == 2)
      return dissociate_edge(map, d);
    else
      return dissociate_face(map, d);
  });
}

template ClaimAnswer try_orbits(const Map2&, int, std::uint64_t, const DissociateFacet<Map2>&);
template ClaimAnswer try_orbits(const Map3&, int, std::uint64_t, const DissociateFacet<Map3>&);
template ClaimAnswer try_orbits(const Map2&, int, std::uint64_t);
template ClaimAnswer try_orbits(const Map3&, int, std::uint64_t);

}  // namespace dartboard
