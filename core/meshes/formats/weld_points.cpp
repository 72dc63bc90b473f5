#include "core/meshes/formats/weld_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/counted.h"
#include "core/base/disjoint_sets.h"
#include "core/meshes/formats/near_points.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct Welder {
  LoadedMesh& loaded;
  double distance;
  const std::string& file;
  std::span<const std::uint32_t> lines;

  [[noreturn]] void refuse(std::size_t c, std::uint32_t a, std::uint32_t b) const {
    const Mesh& mesh = loaded.mesh;
    const std::size_t line = c < lines.size() ? lines[c] : 0;
    throw InputError(fmt::format(
        "{}{}: cell {} ({}) would lose a corner: welding at {} joins its points {} and {}, which are {:.3g} "
        "apart; expected a smaller distance",
        file, line == 0 ? "" : fmt::format(":{}", line), c, name(mesh.kinds[c]), distance,
        loaded.number_in_file(std::min(a, b)), loaded.number_in_file(std::max(a, b)),
        (mesh.points[a] - mesh.points[b]).norm()));
  }

  void require_corners_apart(DisjointSets& joined) const {
    for (std::size_t c = 0; c < loaded.mesh.cell_count(); ++c) {
      const auto nodes = loaded.mesh.cell(c);
      for (std::size_t j = 0; j < nodes.size(); ++j)
        for (std::size_t k = 0; k < j; ++k)
          if (nodes[j] != nodes[k] && joined.set_of(nodes[j]) == joined.set_of(nodes[k])) refuse(c, nodes[k], nodes[j]);
    }
  }

  void renumber(DisjointSets& joined) const {
    Mesh& mesh = loaded.mesh;
    std::vector<std::uint32_t> number(mesh.points.size());
    std::uint32_t kept = 0;
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
      const std::uint32_t first = joined.set_of(p);
      number[p] = first == p ? kept : number[first];
      if (first == p) mesh.points[kept++] = Eigen::Vector3d(mesh.points[p]);
    }
    for (std::uint32_t& node : mesh.nodes) node = number[node];
    if (loaded.place_of_point.empty()) {
      loaded.place_of_point.resize(mesh.points.size());
      std::iota(loaded.place_of_point.begin(), loaded.place_of_point.end(), 0u);
    }
    for (std::uint32_t& place : loaded.place_of_point)
      if (place != LoadedMesh::dropped) place = number[place];
    mesh.points.resize(kept);
  }
};

DisjointSets joined_within(const Mesh& mesh, double distance, double spacing, double& farthest) {
  DisjointSets joined(mesh.points.size());
  for_near_points(mesh.points, distance, spacing, [&](std::uint32_t a, std::uint32_t b, double apart) {
    joined.join(a, b);
    farthest = std::max(farthest, apart);
  });
  return joined;
}

}  // namespace

void weld_points(LoadedMesh& loaded, double distance, const std::string& file,
                 std::span<const std::uint32_t> cell_lines) {
  if (!(distance > 0.0) || !std::isfinite(distance))
    throw InputError(fmt::format("{}: the distance of points to weld is {}; expected more than 0", file, distance));
  const Welder welder{loaded, distance, file, cell_lines};
  // a distance written in decimals must include points whose coordinates were rounded
  double farthest_from_origin = 0.0;
  for (const Eigen::Vector3d& x : loaded.mesh.points)
    farthest_from_origin = std::max(farthest_from_origin, x.cwiseAbs().maxCoeff());
  const double reach = distance + 4.0 * std::numeric_limits<double>::epsilon() * farthest_from_origin;
  const CellEdge shortest = shortest_edge(loaded.mesh);
  if (shortest.length <= reach) welder.refuse(shortest.cell, shortest.a, shortest.b);
  double farthest = 0.0;
  DisjointSets joined = joined_within(loaded.mesh, reach, shortest.length, farthest);
  welder.require_corners_apart(joined);
  const std::size_t welded = loaded.mesh.points.size() - joined.count();
  if (welded == 0) {
    loaded.notices.push_back(fmt::format("welded no points: no two are within {} of each other", distance));
    return;
  }
  welder.renumber(joined);
  loaded.notices.push_back(fmt::format("welded {} to others at most {} away", counted(welded, "point"), distance));
}

std::string open_seams(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  const double shortest = shortest_edge(mesh).length, near = seam_distance(mesh.points, shortest);
  std::uint32_t a = 0, b = 0;
  double farthest = 0.0;
  DisjointSets joined = joined_within(mesh, near, shortest, farthest);
  const std::size_t count = mesh.points.size() - joined.count();
  if (count == 0) return "";
  while (joined.set_of(b) == b) ++b;
  a = joined.set_of(b);
  const std::string found = farthest > 0.0
                                ? fmt::format("{} within {:.3g} of another one",
                                              count == 1 ? "1 point is" : counted(count, "point") + " are", farthest)
                                : fmt::format("{} with another one",
                                              count == 1 ? "1 point coincides" : counted(count, "point") + " coincide");
  // twice the largest distance, rounded to one digit, is more than that distance
  const double enough = farthest > 0.0 ? 2.0 * farthest : near;
  const std::string remedy =
      enough > 0.0
          ? fmt::format("; --weld {0:.1g}, or \"weld\": {0:.1g} in the body of a scene, would join them", enough)
          : "";
  return fmt::format("{}, as in a torn body; for example points {} and {}{}", found, loaded.number_in_file(a),
                     loaded.number_in_file(b), remedy);
}

}  // namespace dartboard
