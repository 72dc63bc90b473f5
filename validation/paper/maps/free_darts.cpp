#include "validation/paper/maps/free_darts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/meshes/generators/mesh_generators.h"
#include "core/topology/build.h"
#include "validation/conservation/remaining_cells.h"

namespace dartboard {

template <class Map>
ClaimAnswer free_darts_are_boundary(const Map& map, const std::vector<std::uint32_t>& point, const Mesh& mesh) {
  constexpr int n = Map::dimension;
  using Points = std::vector<std::uint32_t>;
  std::map<Points, int> cells_of;  // by the points of a side, ascending
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const auto& side : sides_of(mesh.kinds[c])) {
      Points points;
      for (const int k : side) points.push_back(mesh.cell(c)[static_cast<std::size_t>(k)]);
      std::sort(points.begin(), points.end());
      ++cells_of[points];
    }
  std::map<Points, std::size_t> darts_of;  // free ones
  bool free_otherwise = false;
  std::size_t free = 0;
  map.for_each_dart([&](Dart d) {
    for (int i = 0; i < n; ++i) free_otherwise = free_otherwise || map.is_free(i, d);
    if (!map.template is_free<n>(d)) return;
    ++free;
    Points points;
    if constexpr (n == 2) {
      points = {point[d.index], point[map.template alpha<0>(d).index]};
    } else {
      Dart e = d;
      do points.push_back(point[e.index]);
      while ((e = map.template alpha<0, 1>(e)) != d);
    }
    std::sort(points.begin(), points.end());
    ++darts_of[points];
  });
  std::size_t boundary = 0;
  bool right = !free_otherwise;
  for (const auto& [points, cells] : cells_of) {
    const std::size_t darts = cells == 1 ? (n == 2 ? 2 : 2 * points.size()) : 0;
    boundary += cells == 1 ? 1 : 0;
    const auto found = darts_of.find(points);
    right = right && (found == darts_of.end() ? 0 : found->second) == darts;
  }
  return {right && darts_of.size() == boundary,
          fmt::format("{} free darts on {} of {} sides", free, darts_of.size(), boundary)};
}

ClaimAnswer try_free_darts(const Mesh& solid) {
  const auto built = build_map<Map3>(solid);
  const ClaimAnswer open = free_darts_are_boundary(built.map, built.point, solid);
  const auto closed = [](const Mesh& mesh) {
    const auto surface = build_map<Map2>(mesh);
    const ClaimAnswer answer = free_darts_are_boundary(surface.map, surface.point, mesh);
    return answer.holds && answer.measured.starts_with("0 free darts");
  };
  const bool sphere = closed(octasphere(2)), torus = closed(torus_surface(8, 5));
  return {open.holds && sphere && torus,
          fmt::format("{}; closed surfaces: {}", open.measured, sphere && torus ? "none" : "NOT none")};
}

template ClaimAnswer free_darts_are_boundary(const Map2&, const std::vector<std::uint32_t>&, const Mesh&);
template ClaimAnswer free_darts_are_boundary(const Map3&, const std::vector<std::uint32_t>&, const Mesh&);

}  // namespace dartboard
