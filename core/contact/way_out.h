#pragma once
// The search of a contact between bodies: is a place inside a tetrahedron, and which is the nearest way out?

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/contact/box_around.h"
#include "core/contact/candidate_pairs.h"
#include "core/contact/skin_samples.h"
#include "core/contact/skin_solids.h"
#include "core/places/nearest_on_triangle.h"

namespace dartboard {

/// `border`: on a face of the boundary, to rounding.
enum class Side { inside, outside, inverted, border };

/// The side of y by its weights over the corners; `place` is a function of a node. A place between two cells is in one
/// of them, whatever the rounding.
template <class Place>
Side side_of(const SkinTetrahedron& t, const Eigen::Vector3d& y, const Place& place, std::array<double, 4>& weights) {
  using Eigen::Vector3d;
  constexpr double seam = 0x1p-40;  // the weight that a place may have beyond a face
  // the sum of three weights from which on a place is beyond the fourth face
  constexpr double beyond_the_first = 1.0 + 1e-9;
  const Vector3d p = place(t.nodes[0]), a = place(t.nodes[1]) - p, b = place(t.nodes[2]) - p, c = place(t.nodes[3]) - p,
                 r = y - p, normal = b.cross(c);
  const double volume = a.dot(normal);
  if (!(volume > 0.0)) return Side::inverted;
  // Most places are clearly beyond a face, which needs no weight.
  const double least = -2.0 * seam * volume;
  const double part1 = r.dot(normal);
  if (part1 < least) return Side::outside;
  const double part2 = r.dot(c.cross(a));
  if (part2 < least) return Side::outside;
  const double part3 = r.dot(a.cross(b));
  if (part3 < least || part1 + part2 + part3 > beyond_the_first * volume) return Side::outside;
  bool is_on_border = false;
  const auto is_beyond = [&](std::size_t k, double weight) {
    weights[k] = weight;
    is_on_border = is_on_border || ((t.outer >> k & 1u) != 0 && !(weight > 0.0));
    return !(weight > -seam);
  };
  if (is_beyond(1, part1 / volume) || is_beyond(2, part2 / volume) || is_beyond(3, part3 / volume) ||
      is_beyond(0, 1.0 - (weights[1] + weights[2] + weights[3])))
    return Side::outside;
  return is_on_border ? Side::border : Side::inside;
}

/// The ways out of tetrahedra for samples inside of them: each is to the nearest of the boundary triangles at the
/// corners of the tetrahedron, less those with a node of the sample; of equal ones to that of the lowest face and part.
///
/// **Covered ways.** Of bodies that are still, a way that leads from one into another is no way out: what slides over
/// bodies side by side does not feel their sides. The next way is one out of both: through a triangle at the corners of
/// either tetrahedron, or to a line where two of these cross, as in the corner of a step. Gaps narrower than 2^-7 of
/// the depth of the law are none. Where all ways are covered the nearest is taken. Among bodies that move all ways
/// count: which of them cover others would change with rounding, and energies with it.
///
/// A search compares all of these triangles, and keeps the nearest few. As long as places have not moved by as much as
/// the others were farther away, these alone are compared. What is found does not depend on that.
class WaysOut {
 public:
  /// pre  these live as long
  WaysOut(const std::vector<SkinSample>& samples, const SkinSolids& solids, const CandidatePairs& candidates)
      : samples_(samples), solids_(solids), candidates_(candidates) {}

  /// Fill triangle, depth, normal and `nearest` of a touch whose sample is at y. False if y is on the boundary, to
  /// rounding; the triangle is `none` if none is in reach.
  /// pre  the candidates are those at these places; at most once for each sample until they are at others
  bool find(const Eigen::Vector3d& y, const StagePlaces& at, BodyTouch& touch);
  /// Fill it with nothing known: the oracle of ways that are followed.
  bool search(const Eigen::Vector3d& y, const StagePlaces& at, BodyTouch& touch);

  /// Set the groups that do not move.
  void set_still(std::span<const std::uint8_t> groups);
  std::span<const std::uint8_t> still() const { return still_; }
  bool may_be_covered() const { return !still_.empty(); }
  /// To be called before `pass_covered` is at other places.
  void move() { boxes_.clear(); }
  /// A tetrahedron that a sample is inside of, or on the border of.
  struct Within {
    BodyTouch touch;
    double border = 0.0;                    // [m] how far beyond their ends ways lead: narrower gaps are none
    std::uint32_t cover = BodyTouch::none;  // the tetrahedron that its way led into, and that another way was found for
    bool has_depth = false, on_border = false;
  };
  static constexpr std::size_t most_within = 4;
  /// Room for those of one sample.
  std::array<Within, most_within>& within() { return within_; }
  /// Fills each touch of a sample anew whose way is covered, with one that is not. Of two that lead into each other the
  /// longer has no depth any more. False if tetrahedra beyond the reach are needed: then what is found does not count.
  /// pre  the ways are known; `near`, of tetrahedra that the sample may touch, has all within `reach` [m] of y
  bool pass_covered(const Eigen::Vector3d& y, const StagePlaces& at, std::span<const std::uint32_t> near, double reach,
                    std::span<Within> within);

  /// The number of searches.
  std::uint64_t searched() const { return searched_; }
  std::size_t bytes() const;

 private:
  static constexpr std::size_t most_kept = 8;
  /// For a sample.
  struct Known {
    std::uint32_t tetrahedron = BodyTouch::none;
    std::array<std::uint32_t, most_kept> nearest{};  // triangles
    std::uint32_t count = 0;                         // of these
    double others = 0.0;                             // [m] at least the distance of all other triangles
    std::uint64_t call = 0;                          // of the candidates, when that was so
  };
  /// The triangles at the corners of a tetrahedron, each once, and their nodes.
  struct Around {
    std::span<const std::uint32_t> triangles, nodes;
  };
  struct Place {
    std::uint32_t first = 0, triangles = 0, nodes = 0;  // in numbers_; none: not looked for
  };

  Around around(std::uint32_t tetrahedron);
  bool is_followed(const BodyTouch& touch, Known& known);
  bool search(const Eigen::Vector3d& y, const StagePlaces& at, BodyTouch& touch, Known& known);
  bool take(const Eigen::Vector3d& y, const StagePlaces& at, std::uint32_t triangle, BodyTouch& touch) const;
  /// What may cover the ways of one touch.
  struct Covers {
    std::span<const std::uint32_t> near;
    double reach, border;
  };
  bool pass_covered(const Eigen::Vector3d& y, const StagePlaces& at, const Covers& covers, Within& one);
  Eigen::Vector3d normal_of(std::uint32_t triangle, const StagePlaces& at) const;
  std::uint32_t cover_of(const Eigen::Vector3d& y, const StagePlaces& at, const Covers& covers, const BodyTouch& touch,
                         const Eigen::Vector3d& direction);
  bool is_short(const Eigen::Vector3d& y, const StagePlaces& at, const Covers& covers, const BodyTouch& touch);
  void add_ways(const Eigen::Vector3d& y, const StagePlaces& at, std::uint32_t tetrahedron, const BodyTouch& covered);
  TriangleCorners corners_from(const Eigen::Vector3d& y, const StagePlaces& at, std::uint32_t triangle) const;
  bool take(const Eigen::Vector3d& y, const StagePlaces& at, std::uint32_t triangle, const NearestOnTriangle& best,
            BodyTouch& touch) const;

  const std::vector<SkinSample>& samples_;
  const SkinSolids& solids_;
  const CandidatePairs& candidates_;
  std::vector<Known> known_;  // by sample
  std::uint64_t searched_ = 0;
  std::vector<Place> places_;  // by tetrahedron
  std::vector<std::uint32_t> numbers_;
  std::uint64_t changes_ = 0;  // of the skin, up to which these hold
  /// For covered ways.
  struct Way {
    NearestOnTriangle nearest;
    std::uint32_t triangle, across;  // `across`: another, on whose line with the triangle it ends, or none
    bool is_covered;
  };
  bool is_still(std::uint32_t group) const { return group < still_.size() && still_[group] != 0; }
  std::uint32_t group_of(std::uint32_t triangle) const {
    return solids_.group_at(solids_.triangles()[triangle].nodes[0]);
  }
  std::vector<Way> all_ways_;
  std::array<Within, most_within> within_;
  std::vector<std::uint8_t> still_;  // by group; empty where less than two are
  std::vector<BoxAround> boxes_;     // around those that are still; empty: not known
};

}  // namespace dartboard
