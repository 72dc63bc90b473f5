#include "core/mechanics/fracture/tearing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/operations/dissociate_all.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "core/topology/cells.h"

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

// A number rounded to 24 bits (Veltkamp's splitting): numbers that differ by rounding only compare equal.
double rounded(double value) {
  const double spread = value * 536870913.0;  // 2^29 + 1
  return std::isfinite(spread) ? spread - (spread - value) : value;
}

/// How well the normal of the face of d approximates a direction: |n . direction|; negative for a degenerate face.
template <class Map>
double alignment(const Body<Map>& body, Dart d, const Eigen::Vector3d& direction) {
  const auto position = [&](Dart e) { return body.vertices.position[body.vertex(body.map, e)]; };
  const Eigen::Vector3d origin = position(d);
  Eigen::Vector3d here(0, 0, 0), twice_area(0, 0, 0);
  double sides = 0.0;
  for (Dart e = d;;) {  // Newell's sum: a face need not be flat
    e = body.map.template alpha<0, 1>(e);
    const Eigen::Vector3d next = position(e) - origin;
    twice_area += here.cross(next);
    sides += (next - here).squaredNorm();
    here = next;
    if (e == d) break;
  }
  const double norm = std::sqrt(twice_area.squaredNorm());
  if (!(norm > 0x1p-39 * sides)) return -1.0;
  return std::abs(twice_area.dot(direction)) / norm;
}

/// The accepted faces around the vertex of `start` that are connected with its face by edges at that vertex.
template <class Map>
std::vector<Dart> seam_around(const Map& map, Dart start, const FaceFilter& filter) {
  std::vector<Dart> faces;
  Mark met(map);
  const auto meet = [&map, &met, &faces](Dart d) {
    for_each_dart_of(map, Face{d}, [&met](Dart e) { met.set(e); });
    faces.push_back(d);
  };
  meet(start);
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (const Dart corner : {faces[k], map.template alpha<1>(faces[k])})  // its two edges at the vertex
      for_each_dart_of(map, Involutions{2, 3}, corner, [&map, &met, &meet, &filter](Dart d) {
        if (!map.template is_free<3>(d) && !met(d) && filter(d)) meet(d);
      });
  return faces;
}

/// The fan of a face goes on from one of its two sides; this is a dart on the side from which the fan is nearer to the
/// plane across the direction: the larger mean of |n . direction|, then fewer faces, and only then the lower dart.
template <class Map>
Dart better_side(const Body<Map>& body, Dart d, const Eigen::Vector3d& direction) {
  struct Side {
    double alignment;
    std::size_t faces;
    Dart dart;
  };
  const auto side = [&](Dart start) {
    const std::vector<Dart> faces = fan(body.map, start);
    std::vector<double> each;
    for (const Dart face : faces) each.push_back(std::max(0.0, alignment(body, face, direction)));
    std::sort(each.begin(), each.end());  // so that the order of the walk has no effect
    double sum = 0.0;
    for (const double a : each) sum += a;
    return Side{rounded(sum / static_cast<double>(faces.size())), faces.size(), start};
  };
  const Side a = side(d), b = side(body.map.template alpha<3>(d));
  if (a.alignment != b.alignment) return a.alignment > b.alignment ? a.dart : b.dart;
  return a.faces < b.faces || (a.faces == b.faces && a.dart < b.dart) ? a.dart : b.dart;
}

/// The number of places of a vertex, which is smaller once it came apart.
template <class Map>
std::size_t place_count(const Map& map, Dart d) {
  Mark seen(map);
  std::size_t count = 0;
  for_each_place_of(map, Vertex{d}, seen, [&count](Dart) { ++count; });
  return count;
}

/// A vertex above the threshold, given by a dart because numbers change when the body follows a tear.
struct Stressed {
  double value;
  DartId dart;
  std::size_t places;
};

PrincipalStress principal(const Eigen::Matrix3d& stress, std::uint32_t vertex) {
  if (!stress.allFinite()) throw StressError(vertex);
  return principal_stress(stress);
}

}  // namespace

template <class Map>
Dart starting_face(const Body<Map>& body, std::uint32_t k, const Eigen::Vector3d& direction, const FaceFilter& filter,
                   double least_alignment) {
  if (!direction.allFinite() || direction.isZero(0.0))
    throw InputError(fmt::format("a stress direction of ({}, {}, {}), expected finite numbers that are not all zero",
                                 direction.x(), direction.y(), direction.z()));
  const Map& map = body.map;
  const Eigen::Vector3d along = direction.normalized();
  Dart best = no_dart;
  double best_alignment = rounded(least_alignment);
  for_each_dart_of(map, Vertex{body.vertices.dart[k]}, [&](Dart d) {
    const Dart opposite = map.template alpha<3>(d), turned = map.template alpha<1>(d);
    if (opposite == d) return;
    // once for each corner of a face: by the lowest of its four darts there
    if (opposite < d || turned < d || map.template alpha<3>(turned) < d) return;
    if (filter && !filter(d)) return;
    const double found = rounded(alignment(body, d, along));
    if (found < 0.0 || found < best_alignment || (found == best_alignment && best < d)) return;
    best = d;
    best_alignment = found;
  });
  return best;
}

template <class Map>
TornVertices tear_where_stressed(Body<Map>& body, std::span<const std::array<std::uint32_t, 2>> ends,
                                 const TearRule& rule, const FaceFilter& filter, const FollowChange& follow,
                                 std::vector<Eigen::Matrix3d>& stress, ForceTerms terms, const CornerRows& corners) {
  if (!(rule.threshold > 0.0))
    throw InputError(fmt::format("a tear threshold of {}, expected a positive number of Pa", rule.threshold));
  if (!(rule.least_alignment <= 1.0))
    throw InputError(fmt::format("a least alignment of {}, expected at most 1", rule.least_alignment));
  VolumeRoom room;
  vertex_stresses(ends, body.springs, vertex_volumes(body, corners, room), body.vertices.position, stress, terms);

  TornVertices torn;
  std::vector<Stressed> stressed;
  for (std::uint32_t k = 0; k < stress.size(); ++k) {
    // Eigenvalues are needed of the few vertices only that can be above the threshold or the largest.
    if (k > 0 && principal_bound(stress[k]) <= std::min(rule.threshold, torn.largest_stress)) continue;
    const double value = principal(stress[k], k).value;
    torn.largest_stress = k == 0 ? value : std::max(torn.largest_stress, value);
    if (value > rule.threshold) {
      const Dart d = body.vertices.dart[k];
      stressed.push_back({rounded(value), body.map.id(d), place_count(body.map, d)});
    }
  }
  torn.stressed = stressed.size();
  std::sort(stressed.begin(), stressed.end(), [](const Stressed& a, const Stressed& b) {
    return a.value != b.value ? a.value > b.value : a.dart.dart < b.dart.dart;
  });

  for (const Stressed& vertex : stressed) {
    if (torn.tears == rule.most_per_step) break;
    const Dart d = vertex.dart.dart;
    if (!body.map.is_live(d) || body.map.id(d) != vertex.dart) continue;  // `follow` may remove cells
    if (place_count(body.map, d) != vertex.places) continue;              // torn with a neighbour
    const std::uint32_t k = body.vertex(body.map, d);
    const PrincipalStress now = principal(vertex_stress(body, k), k);
    if (!(now.value > rule.threshold)) continue;
    const Dart start = starting_face(body, k, now.direction, filter, rule.least_alignment);
    if (start == no_dart) continue;
    const TopologyChange change = filter ? dissociate_all(body.map, seam_around(body.map, start, filter))
                                         : tear_fan(body.map, better_side(body, start, now.direction));
    ++torn.tears;
    torn.faces += change.faces.size();
    follow(change);
  }
  return torn;
}

DARTBOARD_TEARING(, Map3)
DARTBOARD_TEARING(, TetMap)

}  // namespace dartboard
