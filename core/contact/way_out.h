#pragma once
// The search of a contact between bodies: is a place inside a tetrahedron, and which is the nearest way out?

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>

#include "core/contact/body_contact.h"
#include "core/contact/nearest_on_triangle.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"

namespace dartboard {

enum class Side { inside, outside, inverted };

/// The weight that a place may have beyond a face within the body, over the tetrahedron's altitude there.
inline constexpr double seam_of_sides = 0x1p-40;
/// The sum of three weights, over their whole, from which on a place is beyond the fourth face.
inline constexpr double beyond_the_first = 1.0 + 1e-9;

/// The side of y by its weights over the corners; `place` is a function of a node. Faces on the boundary are part of
/// the outside; a place between two cells is in one of them, whatever the rounding.
template <class Place>
Side side_of(const SkinTetrahedron& t, const Eigen::Vector3d& y, const Place& place, std::array<double, 4>& weights) {
  using Eigen::Vector3d;
  constexpr double seam = seam_of_sides;
  const Vector3d p = place(t.nodes[0]), a = place(t.nodes[1]) - p, b = place(t.nodes[2]) - p, c = place(t.nodes[3]) - p,
                 r = y - p, normal = b.cross(c);
  const double volume = a.dot(normal);
  if (!(volume > 0.0)) return Side::inverted;
  // Most places are clearly beyond a face, which needs no weight.
  const auto may_be_beyond = [&](std::size_t k) { return (t.outer >> k & 1u) != 0 ? 0.0 : -2.0 * seam * volume; };
  const double part1 = r.dot(normal);
  if (part1 < may_be_beyond(1)) return Side::outside;
  const double part2 = r.dot(c.cross(a));
  if (part2 < may_be_beyond(2)) return Side::outside;
  const double part3 = r.dot(a.cross(b));
  if (part3 < may_be_beyond(3) || part1 + part2 + part3 > beyond_the_first * volume) return Side::outside;
  const auto is_beyond = [&](std::size_t k, double weight) {
    weights[k] = weight;
    return !(weight > ((t.outer >> k & 1u) != 0 ? 0.0 : -seam));
  };
  if (is_beyond(1, part1 / volume) || is_beyond(2, part2 / volume) || is_beyond(3, part3 / volume) ||
      is_beyond(0, 1.0 - (weights[1] + weights[2] + weights[3])))
    return Side::outside;
  return Side::inside;
}

/// Tetrahedra by their numbers.
struct TetrahedraToTest {
  const SkinTetrahedron* all;
  std::span<const std::uint32_t> numbers;
};

/// The first of the tetrahedra, from the place `first` on, that y may be inside of: `side_of` decides, whose operations
/// are done here for four at a time in their order. Those that are turned inside out are added to `inverted`.
///
/// returns  their number, where y is outside of all
/// pre      lanes are on, or `first` is returned
std::size_t skip_outside(const TetrahedraToTest& tetrahedra, std::size_t first, const StagePlaces& at,
                         const Eigen::Vector3d& y, std::size_t& inverted);

/// The way out of the tetrahedron for the sample at y: the nearest of the boundary triangles at its corners, less those
/// with a node of the sample. False if y is on the boundary, to rounding.
///
/// `known` is what was found last time for the sample. While no two places have moved, relative to each other, by half
/// of what its triangle was nearer than all others, that triangle is the nearest still, and nothing is searched;
/// otherwise the search begins with it, which saves most of the others.
/// pre  travelled [m] grows by at least the relative movement, from the time on when `known` was set
template <class Place>
bool find_way_out(const SkinSolids& solids, const SkinSample& sample, const Eigen::Vector3d& y, const Place& place,
                  double travelled, KnownWay& known, BodyTouch& touch) {
  using Eigen::Vector3d;
  // Depths below this share of the coordinates are rounding, and distances that differ by less than that are equal.
  constexpr double rounding = 0x1p-46, certain = 0x1p-40;
  // between squared distances that differ by more than rounding
  constexpr double certainly_more = 1.0001;
  const auto& triangles = solids.triangles();
  const auto nearest_on = [&](const SkinTriangle& t) {
    return nearest_on_triangle(place(t.nodes[0]) - y, place(t.nodes[1]) - y, place(t.nodes[2]) - y);
  };
  const auto size_of_coordinates = [&] {
    double size = y.cwiseAbs().maxCoeff();
    for (const std::uint32_t j : triangles[touch.triangle].nodes) size = std::max(size, place(j).cwiseAbs().maxCoeff());
    return size;
  };
  double least = 0.0, coordinates = 0.0;
  NearestOnTriangle best;
  if (known.is_certain(touch.tetrahedron, travelled)) {
    touch.triangle = known.triangle;
    best = nearest_on(triangles[touch.triangle]);
    least = best.way.squaredNorm();
    coordinates = size_of_coordinates();
  } else {
    const auto corners = sample.corners();
    const auto& nodes = solids.tetrahedra()[touch.tetrahedron].nodes;
    const auto has_one_of = [](const SkinTriangle& t, std::span<const std::uint32_t> some) {
      return std::ranges::any_of(t.nodes, [some](std::uint32_t j) { return std::ranges::find(some, j) != some.end(); });
    };
    touch.triangle = BodyTouch::none;
    double second = std::numeric_limits<double>::infinity();  // no other is nearer than its root
    const auto compare = [&](std::uint32_t k) {
      const SkinTriangle& t = triangles[k];
      if (k == touch.triangle || has_one_of(t, corners)) return;
      const Vector3d a = place(t.nodes[0]) - y, b = place(t.nodes[1]) - y, c = place(t.nodes[2]) - y;
      if (touch.triangle != BodyTouch::none) {
        const Vector3d to_box = a.cwiseMin(b).cwiseMin(c).cwiseMax(-a.cwiseMax(b).cwiseMax(c)).cwiseMax(0.0);
        if (const double square = to_box.squaredNorm(); square > certainly_more * least) {
          second = std::min(second, square);
          return;
        }
      }
      const NearestOnTriangle found = nearest_on_triangle(a, b, c);
      const double square = found.way.squaredNorm();
      if (std::isnan(square)) return;
      if (touch.triangle != BodyTouch::none) {
        second = std::min(second, std::max(square, least));
        if (!(square <= least)) return;
        const SkinTriangle& other = triangles[touch.triangle];
        if (square == least && std::tie(other.face, other.part) < std::tie(t.face, t.part)) return;
      }
      least = square;
      best = found;
      touch.triangle = k;
    };
    if (known.triangle < triangles.size() && has_one_of(triangles[known.triangle], nodes)) compare(known.triangle);
    for (std::size_t corner = 0; corner < nodes.size(); ++corner)
      solids.for_each_triangle_at(nodes[corner], [&](std::uint32_t k) {
        if (!has_one_of(triangles[k], std::span(nodes).first(corner))) compare(k);
      });
    known = {touch.tetrahedron, touch.triangle};
    if (touch.triangle == BodyTouch::none) return true;
    coordinates = size_of_coordinates();
    const double nearer = std::sqrt(second) - std::sqrt(least);
    known.until =
        std::min(travelled + 0.5 * (1.0 - 1e-6) * nearer - certain * coordinates, std::numeric_limits<double>::max());
  }
  touch.depth = std::sqrt(least);
  if (!(touch.depth > rounding * coordinates)) return false;
  touch.normal = best.way / touch.depth;
  touch.nearest = best.weight;
  return true;
}

}  // namespace dartboard
