#include "validation/topology/topology_claims.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "core/topology/summary.h"

namespace dartboard {
namespace {

// The adjacency graph of a map: each volume as the set of its vertices, each vertex by the label that it has in `name`.
std::multiset<std::set<std::uint32_t>> graph(const TetMap& map, const std::vector<std::uint32_t>& name) {
  std::multiset<std::set<std::uint32_t>> volumes;
  for_each_cell<3>(map, [&](Volume v) {
    std::set<std::uint32_t> nodes;
    for_each_dart_of(map, v, [&](Dart d) { nodes.insert(name[TetMap::slot<0>(d)]); });
    volumes.insert(nodes);
  });
  return volumes;
}

}  // namespace

ClaimAnswer try_to_leave_the_class(const Mesh& mesh, int operations, std::uint64_t seed) {
  Map3 map = build_map<Map3>(mesh).map;
  SplitMix64 random(seed);
  int sewn = 0, removed = 0, dissociated = 0;
  for (int k = 0; k < operations && map.dart_count() > 0; ++k) {
    Dart d{random.below(map.capacity())};
    while (!map.is_live(d)) d = {random.below(map.capacity())};
    if (map.is_free<3>(d)) {  // try to sew it to some other face, or to one that is taken
      const Dart e{random.below(map.capacity())};
      try {
        sew<3>(map, d, e);
        ++sewn;
      } catch (const TopologyError&) {
      }
    } else if (k % 8 == 0) {
      const auto cell = orbit(map, Volume{d});
      for (const Dart e : cell) dissociate_face(map, e);
      remove_cell(map, d);
      ++removed;
    } else {
      dissociate_face(map, d);
      ++dissociated;
    }
    if (const auto violation = check(map); !violation.empty())
      return {false, fmt::format("operation {}: {}", k, violation)};
  }
  return {true, fmt::format("{} dissociations, {} removals, {} sews: valid after each", dissociated, removed, sewn)};
}

ClaimAnswer try_non_manifold_inputs() {
  const auto tetrahedra = [](std::vector<std::array<std::uint32_t, 4>> cells) {
    Mesh mesh;
    for (std::uint32_t p = 0; p < 7; ++p) mesh.points.emplace_back(p, p * p % 5, p * p * p % 7);
    for (const auto& cell : cells) mesh.add_cell(CellKind::tetrahedron, cell);
    return mesh;
  };
  const auto at_edge = summarize(build_map<Map3>(tetrahedra({{0, 1, 2, 3}, {0, 1, 4, 5}})).map);
  const auto at_vertex = summarize(build_map<Map3>(tetrahedra({{0, 1, 2, 3}, {0, 4, 5, 6}})).map);
  std::string refusal;
  try {
    build_map<Map3>(tetrahedra({{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}}));
  } catch (const InputError& error) {
    refusal = error.what();
  }
  const bool apart =
      at_edge.components == 2 && at_vertex.components == 2 && at_edge.cells[0] == 8 && at_vertex.cells[0] == 8;
  return {apart && !refusal.empty(),
          fmt::format("edge: {} components; vertex: {} components; third cell on a face: {}", at_edge.components,
                      at_vertex.components, refusal.empty() ? "accepted" : "refused")};
}

ClaimAnswer try_same_graph_twice(const Mesh& mesh) {
  const auto built = build_map<TetMap>(mesh);
  const TetMap& whole = built.map;
  for (std::uint32_t d = 0; d < whole.capacity(); d += 6) {
    if (whole.is_free<3>({d})) continue;
    TetMap cut = whole;
    const TopologyChange change = dissociate_face(cut, Dart{d});
    if (!change.vertices.empty() || !change.edges.empty()) continue;
    const bool same_graph = graph(whole, built.point) == graph(cut, built.point) &&
                            count_cells<0>(whole) == count_cells<0>(cut) &&
                            count_cells<1>(whole) == count_cells<1>(cut);
    const bool different = !are_isomorphic(whole, cut);
    return {same_graph && different,
            fmt::format("graphs {}, maps {} ({} and {} faces)", same_graph ? "equal" : "differ",
                        different ? "differ" : "isomorphic", count_cells<2>(whole), count_cells<2>(cut))};
  }
  return {false, "every inner face takes an edge or a vertex apart"};
}

ClaimAnswer try_combinatorial_round_trip(const Mesh& mesh) {
  const Map3 map = build_map<Map3>(mesh).map;
  return comes_back(map, to_combinatorial_map(map));
}

ClaimAnswer comes_back(const Map3& map, const CombinatorialMap& half) {
  const bool same = are_isomorphic(map, to_generalized_map<3>(half));
  return {same, fmt::format("{} darts, {} in the combinatorial map, {} on return", map.dart_count(), half.beta.size(),
                            same ? "isomorphic" : "not isomorphic")};
}

}  // namespace dartboard
