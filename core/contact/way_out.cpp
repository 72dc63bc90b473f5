#include "core/contact/way_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/bytes.h"
#include "core/places/nearest_on_triangle.h"

namespace dartboard {

using Eigen::Vector3d;

namespace {

/// Depths below this share of the coordinates are rounding, and distances that differ by less than that are equal.
constexpr double rounding = 0x1p-46, certain = 0x1p-40;
/// Above 1 by more than the rounding of distances and ways.
constexpr double certainly_more = 1.0 + 1e-6;
/// Of the margin of lists: triangles farther away than the nearest by more are not kept. A larger share saves few
/// searches, and costs as much as they do.
constexpr double share_kept = 0.25;

bool has_one_of(const SkinTriangle& t, std::span<const std::uint32_t> some) {
  return std::ranges::any_of(t.nodes, [some](std::uint32_t j) { return std::ranges::find(some, j) != some.end(); });
}

/// The nearest to y of the triangles that are compared, in whatever order.
template <std::size_t most>
class NearestTriangles {
 public:
  struct Ranked {
    double square;  // [m^2] the squared distance
    std::uint32_t triangle;
  };

  NearestTriangles(const std::vector<SkinTriangle>& triangles, const StagePlaces& at, const Vector3d& y)
      : triangles_(triangles), at_(at), y_(y) {}

  void compare(std::uint32_t k) {
    const auto& n = triangles_[k].nodes;
    rank(k, nearest_on_triangle(at_.place(n[0]) - y_, at_.place(n[1]) - y_, at_.place(n[2]) - y_).way.squaredNorm());
  }
  /// From the nearest on; of equal ones the lowest face and part is first. None is at a distance that is no number.
  std::span<const Ranked> ranked() const { return {ranked_.data(), count_}; }
  /// [m^2] The squared distance of the nearest one that is not among them.
  double others() const { return others_; }

 private:
  bool is_before(const Ranked& a, const Ranked& b) const {
    if (a.square != b.square) return a.square < b.square;
    const SkinTriangle &t = triangles_[a.triangle], &u = triangles_[b.triangle];
    return std::tie(t.face, t.part) < std::tie(u.face, u.part);
  }
  void rank(std::uint32_t k, double square) {
    if (std::isnan(square)) return;
    const Ranked one{square, k};
    if (count_ == most) {
      if (!is_before(one, ranked_[most - 1])) {
        others_ = std::min(others_, square);
        return;
      }
      others_ = ranked_[--count_].square;
    }
    std::size_t place = count_++;
    for (; place > 0 && is_before(one, ranked_[place - 1]); --place) ranked_[place] = ranked_[place - 1];
    ranked_[place] = one;
  }

  const std::vector<SkinTriangle>& triangles_;
  const StagePlaces& at_;
  const Vector3d& y_;
  std::array<Ranked, most> ranked_;
  std::size_t count_ = 0;
  double others_ = std::numeric_limits<double>::infinity();
};

/// The largest coordinate of y and of a triangle.
double coordinates_of(const SkinTriangle& t, const StagePlaces& at, const Vector3d& y) {
  double size = y.cwiseAbs().maxCoeff();
  for (const std::uint32_t j : t.nodes) size = std::max(size, at.place(j).cwiseAbs().maxCoeff());
  return size;
}

}  // namespace

WaysOut::Around WaysOut::around(std::uint32_t tetrahedron) {
  if (changes_ != solids_.changes() || places_.size() != solids_.tetrahedra().size()) {
    places_.assign(solids_.tetrahedra().size(), {});
    numbers_.clear();
    changes_ = solids_.changes();
  }
  Place& place = places_[tetrahedron];
  if (place.triangles == 0) {
    const std::size_t first = numbers_.size();
    const auto add = [this](std::size_t from, std::uint32_t number) {
      if (std::ranges::find(std::span(numbers_).subspan(from), number) == std::span(numbers_).end())
        numbers_.push_back(number);
    };
    for (const std::uint32_t node : solids_.tetrahedra()[tetrahedron].nodes)
      solids_.for_each_triangle_at(node, [&](std::uint32_t k) { add(first, k); });
    const std::size_t middle = numbers_.size();
    for (std::size_t k = first; k < middle; ++k)
      for (const std::uint32_t node : solids_.triangles()[numbers_[k]].nodes) add(middle, node);
    place = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(middle - first),
             static_cast<std::uint32_t>(numbers_.size() - middle)};
  }
  const std::span<const std::uint32_t> all(numbers_);
  return {all.subspan(place.first, place.triangles), all.subspan(place.first + place.triangles, place.nodes)};
}

/// Are the nearest known since the last call? The distance of the others has shrunk by no more than places have moved
/// relative to each other.
bool WaysOut::is_followed(const BodyTouch& touch, Known& known) {
  if (known.count == 0 || known.tetrahedron != touch.tetrahedron || candidates_.call() != known.call + 1) return false;
  double own = 0.0, most = 0.0;
  for (const std::uint32_t i : samples_[touch.sample].corners()) own = std::max(own, candidates_.way_of(i));
  for (const std::uint32_t i : around(touch.tetrahedron).nodes) most = std::max(most, candidates_.way_of(i));
  known.others -= certainly_more * (own + most);
  known.call = candidates_.call();
  return true;
}

bool WaysOut::find(const Vector3d& y, const StagePlaces& at, BodyTouch& touch) {
  if (known_.size() != samples_.size()) known_.assign(samples_.size(), {});
  Known& known = known_[touch.sample];
  if (is_followed(touch, known)) {
    NearestTriangles<most_kept> nearest(solids_.triangles(), at, y);
    for (const std::uint32_t k : std::span(known.nearest).first(known.count)) nearest.compare(k);
    if (!nearest.ranked().empty()) {
      const bool has_depth = take(y, at, nearest.ranked()[0].triangle, touch);
      if (certainly_more * touch.depth < known.others) return has_depth;
    }
  }
  return search(y, at, touch, known);
}

bool WaysOut::search(const Vector3d& y, const StagePlaces& at, BodyTouch& touch) {
  Known nothing;
  return search(y, at, touch, nothing);
}

bool WaysOut::search(const Vector3d& y, const StagePlaces& at, BodyTouch& touch, Known& known) {
  ++searched_;
  const auto& triangles = solids_.triangles();
  const auto corners = samples_[touch.sample].corners();
  const bool may_share_nodes = solids_.group_at(corners[0]) == solids_.tetrahedra()[touch.tetrahedron].group;
  NearestTriangles<most_kept> nearest(triangles, at, y);
  for (const std::uint32_t k : around(touch.tetrahedron).triangles)
    if (!(may_share_nodes && has_one_of(triangles[k], corners))) nearest.compare(k);
  known = {.tetrahedron = touch.tetrahedron, .call = candidates_.call()};
  touch.triangle = BodyTouch::none;
  if (nearest.ranked().empty()) return true;
  const double far = std::sqrt(nearest.ranked()[0].square) + share_kept * candidates_.margin();
  double others = std::sqrt(nearest.others());
  for (const auto& one : nearest.ranked()) {
    if (const double distance = std::sqrt(one.square); known.count > 0 && distance > far) {
      others = distance;
      break;
    }
    known.nearest[known.count++] = one.triangle;
  }
  const double coordinates = coordinates_of(triangles[known.nearest[0]], at, y);
  known.others = std::min(others, std::numeric_limits<double>::max()) - certain * coordinates;
  return take(y, at, known.nearest[0], touch);
}

/// Fills a touch whose nearest triangle is known.
bool WaysOut::take(const Vector3d& y, const StagePlaces& at, std::uint32_t triangle, BodyTouch& touch) const {
  const auto& n = solids_.triangles()[triangle].nodes;
  return take(y, at, triangle, nearest_on_triangle(at.place(n[0]) - y, at.place(n[1]) - y, at.place(n[2]) - y), touch);
}
bool WaysOut::take(const Vector3d& y, const StagePlaces& at, std::uint32_t triangle, const NearestOnTriangle& best,
                   BodyTouch& touch) const {
  touch.triangle = triangle;
  touch.nearest = best.weight;
  touch.depth = best.way.norm();
  if (!(touch.depth > rounding * coordinates_of(solids_.triangles()[triangle], at, y))) return false;
  touch.normal = best.way / touch.depth;
  return true;
}

void WaysOut::set_still(std::span<const std::uint8_t> groups) {
  still_.assign(groups.begin(), groups.end());
  if (std::ranges::count(still_, std::uint8_t{1}) < 2) still_.clear();
}

/// May what covers the way be beyond the reach?
bool WaysOut::is_short(const Vector3d& y, const StagePlaces& at, const Covers& covers, const BodyTouch& touch) {
  const double by = certainly_more * (touch.depth + covers.border);
  if (by <= covers.reach) return false;
  if (boxes_.empty()) {
    boxes_.resize(still_.size());
    for (const SkinTetrahedron& t : solids_.tetrahedra()) {
      if (!is_still(t.group)) continue;
      BoxAround& box = boxes_[t.group];
      for (const std::uint32_t i : t.nodes) {
        const Vector3d place = at.place(i);
        box.low = box.low.cwiseMin(place);
        box.high = box.high.cwiseMax(place);
      }
    }
  }
  const std::uint32_t from = solids_.tetrahedra()[touch.tetrahedron].group;
  for (std::uint32_t c = 0; c < boxes_.size(); ++c)
    if (is_still(c) && c != from && (boxes_[c].low - y).cwiseMax(y - boxes_[c].high).maxCoeff() <= by) return true;
  return false;
}

Vector3d WaysOut::normal_of(std::uint32_t triangle, const StagePlaces& at) const {
  const auto& n = solids_.triangles()[triangle].nodes;
  return (at.place(n[1]) - at.place(n[0])).cross(at.place(n[2]) - at.place(n[0])).normalized();
}

/// The tetrahedron that the way of a touch leads into, a little beyond its end, where the surface is left in this
/// direction: of another body than the one that it leads out of, or of that through whose triangle it would come in.
std::uint32_t WaysOut::cover_of(const Vector3d& y, const StagePlaces& at, const Covers& covers, const BodyTouch& touch,
                                const Vector3d& direction) {
  const TriangleCorners corner = corners_from(y, at, touch.triangle);
  const Vector3d end =
      y + (corner[0] + touch.nearest[1] * (corner[1] - corner[0]) + touch.nearest[2] * (corner[2] - corner[0]));
  const Vector3d beyond = end + covers.border * direction;
  const auto place = [&at](std::uint32_t i) { return at.place(i); };
  const auto& tetrahedra = solids_.tetrahedra();
  const std::uint32_t from = tetrahedra[touch.tetrahedron].group,
                      left = group_of(touch.triangle) == from ? from : BodyTouch::none;
  std::uint32_t cover = BodyTouch::none;
  for (const std::uint32_t k : covers.near) {
    const SkinTetrahedron& t = tetrahedra[k];
    std::array<double, 4> weights{};
    if (!is_still(t.group) || t.group == left || side_of(t, beyond, place, weights) != Side::inside) continue;
    if (cover == BodyTouch::none || std::tie(t.cell, t.part) < std::tie(tetrahedra[cover].cell, tetrahedra[cover].part))
      cover = k;
  }
  return cover;
}

TriangleCorners WaysOut::corners_from(const Vector3d& y, const StagePlaces& at, std::uint32_t triangle) const {
  const auto& n = solids_.triangles()[triangle].nodes;
  return {at.place(n[0]) - y, at.place(n[1]) - y, at.place(n[2]) - y};
}

/// The ways through the triangles at a tetrahedron, and those to the lines where these cross the triangle of a way that
/// it covers.
void WaysOut::add_ways(const Vector3d& y, const StagePlaces& at, std::uint32_t tetrahedron, const BodyTouch& covered) {
  const auto corners = samples_[covered.sample].corners();
  const auto add = [this](std::uint32_t triangle, std::uint32_t across, const NearestOnTriangle& nearest) {
    if (!std::isnan(nearest.way.squaredNorm())) all_ways_.push_back({nearest, triangle, across, false});
  };
  for (const std::uint32_t k : around(tetrahedron).triangles) {
    if (has_one_of(solids_.triangles()[k], corners)) continue;
    const auto is_way = [this](std::uint32_t triangle, std::uint32_t across) {
      return std::ranges::any_of(all_ways_,
                                 [=](const Way& way) { return way.triangle == triangle && way.across == across; });
    };
    const TriangleCorners other = corners_from(y, at, k);
    if (!is_way(k, BodyTouch::none)) add(k, BodyTouch::none, nearest_on_triangle(other[0], other[1], other[2]));
    if (k == covered.triangle || is_way(covered.triangle, k)) continue;
    if (const auto nearest = nearest_on_both(corners_from(y, at, covered.triangle), other))
      add(covered.triangle, k, *nearest);
  }
}

bool WaysOut::pass_covered(const Vector3d& y, const StagePlaces& at, std::span<const std::uint32_t> near, double reach,
                           std::span<Within> within) {
  const auto group = [this](std::uint32_t tetrahedron) { return solids_.tetrahedra()[tetrahedron].group; };
  bool is_within_reach = true;
  for (Within& one : within) {
    // what is inside of one cell of a body is on the border of others there
    const bool is_known = std::ranges::any_of(within, [&](const Within& other) {
      return &other != &one && group(other.touch.tetrahedron) == group(one.touch.tetrahedron) &&
             (!other.on_border || &other < &one);
    });
    if (one.on_border && is_known)
      one.has_depth = false;
    else if (one.touch.triangle != BodyTouch::none && is_still(group(one.touch.tetrahedron)))
      is_within_reach = pass_covered(y, at, {near, reach, one.border}, one) && is_within_reach;
  }
  // of two that lead into each other the shorter counts, of equal ones the first
  const auto leads_into = [&](const Within& one, const Within& other) {
    return one.cover != BodyTouch::none && group(one.cover) == group(other.touch.tetrahedron);
  };
  for (std::size_t k = 0; k < within.size(); ++k)
    for (std::size_t j = k + 1; j < within.size(); ++j) {
      Within &one = within[k], &other = within[j];
      if (one.has_depth && other.has_depth && (leads_into(one, other) || leads_into(other, one)))
        (one.touch.depth <= other.touch.depth ? other : one).has_depth = false;
    }
  return is_within_reach;
}

/// False if what may cover a way is beyond the reach.
bool WaysOut::pass_covered(const Vector3d& y, const StagePlaces& at, const Covers& covers, Within& one) {
  bool is_within_reach = !is_short(y, at, covers, one.touch);
  const std::uint32_t first = cover_of(y, at, covers, one.touch, normal_of(one.touch.triangle, at));
  if (first == BodyTouch::none) return is_within_reach;
  ++searched_;
  one.cover = first;
  all_ways_.clear();
  add_ways(y, at, one.touch.tetrahedron, one.touch);
  BodyTouch next = one.touch;
  std::size_t tried = 0;
  while (tried < all_ways_.size() &&
         (all_ways_[tried].triangle != next.triangle || all_ways_[tried].across != BodyTouch::none))
    ++tried;
  for (std::uint32_t cover = first; cover != BodyTouch::none;) {
    if (tried < all_ways_.size()) all_ways_[tried].is_covered = true;
    add_ways(y, at, cover, next);
    const auto order = [this](const Way& way) {
      const SkinTriangle& t = solids_.triangles()[way.triangle];
      const std::uint32_t face = way.across == BodyTouch::none ? 0 : solids_.triangles()[way.across].face + 1;
      return std::tuple(way.is_covered, way.nearest.way.squaredNorm(), t.face, t.part, face);
    };
    const auto best = std::ranges::min_element(all_ways_, {}, order);
    if (best == all_ways_.end() || best->is_covered) return is_within_reach;
    tried = static_cast<std::size_t>(best - all_ways_.begin());
    const bool has_depth = take(y, at, best->triangle, best->nearest, next);
    is_within_reach = !is_short(y, at, covers, next) && is_within_reach;
    Vector3d outwards = normal_of(best->triangle, at);
    if (best->across != BodyTouch::none) outwards = (outwards + normal_of(best->across, at)).normalized();
    cover = cover_of(y, at, covers, next, outwards);
    if (cover != BodyTouch::none) continue;
    one.touch = next;
    one.has_depth = has_depth;
  }
  return is_within_reach;
}

std::size_t WaysOut::bytes() const { return bytes_of(known_, places_, numbers_, all_ways_, still_, boxes_); }

}  // namespace dartboard
