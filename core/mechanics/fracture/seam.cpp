#include "core/mechanics/fracture/seam.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "core/mechanics/element_nodes.h"
#include "core/places/border.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;
using Numbers = boost::container::small_vector<std::uint32_t, 48>;

/// The numbers of the vertices of a cell, ascending, so that the order of the walk has no effect.
template <int i, class Map>
Numbers vertices_of(const Body<Map>& body, Cell<i> cell) {
  Numbers numbers;
  const auto add = [&body, &numbers](Dart d) { numbers.push_back(body.vertex(body.map, d)); };
  if constexpr (Map::tetrahedral && i == 3)
    for (const Dart d : corners_from(body.map, cell.dart)) add(d);
  else
    for_each_dart_of(body.map, cell, add);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// The mean of the vertices' positions [m].
template <int i, class Map>
Eigen::Vector3d middle(const Body<Map>& body, Dart d) {
  const Numbers nodes = vertices_of(body, Cell<i>{d});
  Eigen::Vector3d sum(0, 0, 0);
  for (const std::uint32_t k : nodes) sum += body.vertices.position[k];
  return sum / static_cast<double>(nodes.size());
}

template <class Map>
std::vector<Dart> facets_on_plane(const Body<Map>& body, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  constexpr int n = Map::dimension;
  if (!point.allFinite() || !normal.allFinite() || normal.isZero(0.0))
    throw InputError(
        fmt::format("a plane through ({}, {}, {}) with normal ({}, {}, {}), expected finite numbers and a "
                    "normal that is not zero",
                    point.x(), point.y(), point.z(), normal.x(), normal.y(), normal.z()));
  const double thickness = border_thickness(body.vertices.position);
  std::vector<bool> in_front(body.cell_dart.size());
  for (std::size_t c = 0; c < in_front.size(); ++c)
    in_front[c] = is_in_front(middle<n>(body, body.cell_dart[c]), point, normal, thickness);
  return facets_between(body, [&](std::uint32_t a, std::uint32_t b) { return in_front[a] != in_front[b]; });
}

/// Does the segment from a to b cross the parallelogram at `corner` along u and w? Its border is part of it, so that
/// nothing slips through where two of them meet.
bool crosses(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& corner,
             const Eigen::Vector3d& u, const Eigen::Vector3d& w, double thickness) {
  const Eigen::Vector3d normal = u.cross(w);
  if (is_in_front(a, corner, normal, thickness) == is_in_front(b, corner, normal, thickness)) return false;
  const double above_a = (a - corner).dot(normal), above_b = (b - corner).dot(normal);
  const double at =
      std::clamp(above_a / (above_a - above_b), 0.0, 1.0);  // outside [0, 1] where an end is within the thickness
  const Eigen::Vector3d there = a + at * (b - a) - corner;
  const double s = there.cross(w).dot(normal) / normal.squaredNorm(),
               t = u.cross(there).dot(normal) / normal.squaredNorm();
  const double along_u = u.norm(), along_w = w.norm();
  const double size = std::max({a.lpNorm<Eigen::Infinity>(), corner.lpNorm<Eigen::Infinity>(), along_u, along_w});
  return is_inside(std::min(s, 1.0 - s) * along_u, size, thickness) &&
         is_inside(std::min(t, 1.0 - t) * along_w, size, thickness);
}

// Call f(choice) for every way to choose N of the ascending numbers, each choice ascending.
template <std::size_t N, class F>
void for_each_choice(const Numbers& numbers, F&& f, std::array<std::uint32_t, N> choice = {}, std::size_t chosen = 0,
                     std::size_t from = 0) {
  if (chosen == N) return f(choice);
  for (std::size_t k = from; k < numbers.size(); ++k) {
    choice[chosen] = numbers[k];
    for_each_choice<N>(numbers, f, choice, chosen + 1, k + 1);
  }
}

template <std::size_t N, class Map>
std::vector<Dart> facets_of_points(const Body<Map>& body, std::span<const std::array<std::uint32_t, N>> wanted) {
  constexpr int n = Map::dimension;
  std::vector<std::array<std::uint32_t, N>> sorted(wanted.begin(), wanted.end());
  for (auto& points : sorted) std::sort(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());

  std::vector<bool> found(sorted.size(), false);
  std::vector<Dart> seam;
  for_each_inner_facet(body.map, [&](Dart d) {
    Numbers points = vertices_of(body, Cell<n - 1>{d});
    for (std::uint32_t& p : points) p = body.vertices.point[p];
    points.erase(std::remove(points.begin(), points.end(), no_point), points.end());  // these have no mesh point
    std::sort(points.begin(), points.end());
    bool wanted_here = false;
    for_each_choice<N>(points, [&](const std::array<std::uint32_t, N>& choice) {
      const auto at = std::lower_bound(sorted.begin(), sorted.end(), choice);
      if (at == sorted.end() || *at != choice) return;
      found[static_cast<std::size_t>(at - sorted.begin())] = true;
      wanted_here = true;
    });
    if (wanted_here) seam.push_back(d);
  });
  if (const auto missing = std::find(found.begin(), found.end(), false); missing != found.end())
    throw InputError(fmt::format("a seam names the points {}, expected those of an interior {}",
                                 fmt::join(sorted[static_cast<std::size_t>(missing - found.begin())], ", "),
                                 n == 3 ? "face" : "edge"));
  return seam;
}

}  // namespace

template <class Map>
Eigen::Vector3d facet_centre(const Body<Map>& body, Dart d) {
  return middle<Map::dimension - 1>(body, d);
}

bool crosses_sweep(std::span<const Eigen::Vector3d> path, const Eigen::Vector3d& depth, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b, double thickness) {
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg)
    if (crosses(a, b, path[leg], path[leg + 1] - path[leg], depth, thickness)) return true;
  return false;
}

template <class Map>
std::vector<Dart> facets_on_sweep(const Body<Map>& body, std::span<const Eigen::Vector3d> path,
                                  const Eigen::Vector3d& depth) {
  constexpr int n = Map::dimension;
  std::vector<Eigen::Vector3d> centre;
  centre.reserve(body.cell_dart.size());
  for (const Dart d : body.cell_dart) centre.push_back(middle<n>(body, d));
  const double thickness = border_thickness(body.vertices.position);
  return facets_between(body, [&](std::uint32_t a, std::uint32_t b) {
    return crosses_sweep(path, depth, centre[a], centre[b], thickness);
  });
}

template <class Map>
FaceSet::FaceSet(const Map& map, std::span<const Dart> faces) : in_(map.template slot_count<2>(), false) {
  for (const Dart face : faces)
    for_each_dart_of(map, Face{face}, [this](Dart d) { in_[Map::template slot<2>(d)] = true; });
}

template <class Map>
std::vector<Dart> faces_on_plane(const MassSpringBody<Map, Held::by_every_dart>& body, const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& normal) {
  return facets_on_plane(body, point, normal);
}

template <class Map>
std::vector<Dart> faces_of_points(const MassSpringBody<Map, Held::by_every_dart>& body,
                                  std::span<const std::array<std::uint32_t, 3>> triples) {
  return facets_of_points<3>(body, triples);
}

std::vector<Dart> edges_on_plane(const MassSpringBody<Map2, Held::by_every_dart>& body, const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& normal) {
  return facets_on_plane(body, point, normal);
}

std::vector<Dart> edges_of_points(const MassSpringBody<Map2, Held::by_every_dart>& body,
                                  std::span<const std::array<std::uint32_t, 2>> pairs) {
  return facets_of_points<2>(body, pairs);
}

DARTBOARD_SEAMS(, Map3)
DARTBOARD_SEAMS(, TetMap)
template Eigen::Vector3d facet_centre(const Body<Map2>&, Dart);
template std::vector<Dart> facets_on_sweep(const Body<Map2>&, std::span<const Eigen::Vector3d>, const Eigen::Vector3d&);

}  // namespace dartboard
