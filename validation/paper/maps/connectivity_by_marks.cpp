#include "validation/paper/maps/connectivity_by_marks.h"

#include <fmt/format.h>

#include "core/operations/dissociate_face.h"
#include "core/plain/random.h"
#include "core/topology/orbit.h"
#include "validation/conservation/mesh_places.h"

namespace dartboard {

bool all_darts_are_marked(const Map3& map) {
  Dart first = no_dart;
  map.for_each_dart([&](Dart d) { first = first == no_dart ? d : first; });
  if (first == no_dart) return true;
  Mark marked(map);
  marked.set(first);
  detail::walk(map, all_involutions(3), first, marked, [](Dart) {});
  bool all = true;
  map.for_each_dart([&](Dart d) { all = all && marked(d); });
  return all;
}

ClaimAnswer try_marking(const Mesh& mesh, int series, std::uint64_t seed,
                        const std::function<bool(const Map3&)>& is_connected) {
  Problem problem;
  problem.mesh = mesh;
  const auto body = build_body<Map3, Held::by_every_dart>(problem);
  SplitMix64 random(seed);
  int asked = 0, lost = 0;
  for (int k = 0; k < series; ++k) {
    Map3 map = body.map;
    RemainingCells cells(mesh);
    const MeshPlaces places(body, mesh, cells);
    for (bool connected = true; connected;) {
      const std::uint32_t side = cells.joined_side(random).value();
      dissociate_face(map, places.side[side]);
      cells.dissociate(side);
      connected = cells.count_components() == 1;
      ++asked;
      lost += connected ? 0 : 1;
      if (is_connected(map) != connected)
        return {false, fmt::format("dissociation {} of series {}: the cells {}, the marks say otherwise", asked, k,
                                   connected ? "hang together" : "do not hang together")};
    }
  }
  return {lost == series && asked > 2 * series,
          fmt::format("{} questions in {} series, {} losses of connectivity: all reported, and no other", asked, series,
                      lost)};
}

}  // namespace dartboard
