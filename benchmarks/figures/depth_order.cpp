#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <vector>

#include "benchmarks/figures/body_facets.h"

namespace dartboard {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A part of a facet as it is seen, its corners counterclockwise.
struct Triangle {
  std::array<Vector3d, 3> x;
  double area;  // as seen, twice

  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) : x{a, b, c} {
    area = cross((b - a).head<2>(), (c - a).head<2>());
    if (area < 0.0) {
      std::swap(x[1], x[2]);
      area = -area;
    }
  }
  /// Twice the area between side k and a place: positive inside.
  double beyond_side(std::size_t k, const Vector2d& p) const {
    const Vector2d from = x[k].head<2>();
    return cross(x[(k + 1) % 3].head<2>() - from, p - from);
  }
  /// The depth of its plane at a place.
  double depth_at(const Vector2d& p) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += beyond_side(k, p) * x[(k + 2) % 3].z();
    return sum / area;
  }
};

/// The places at which two facets are seen one over the other.
struct Overlap {
  double size = 0.0;    // their measure: area, length or number
  double nearer = 0.0;  // the integral over them of how much nearer to the viewer the first facet is
};

void add_overlap(const Triangle& a, const Triangle& b, Overlap& sum) {
  std::array<Vector2d, 9> part, clipped;
  std::size_t count = 3;
  for (std::size_t k = 0; k < 3; ++k) part[k] = a.x[k].head<2>();
  for (std::size_t side = 0; side < 3 && count > 0; ++side) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d &here = part[k], &next = part[(k + 1) % count];
      const double at_here = b.beyond_side(side, here), at_next = b.beyond_side(side, next);
      if (at_here >= 0.0) clipped[kept++] = here;
      if ((at_here >= 0.0) != (at_next >= 0.0))
        clipped[kept++] = here + (next - here) * (at_here / (at_here - at_next));
    }
    part = clipped;
    count = kept;
  }
  for (std::size_t k = 2; k < count; ++k) {
    const double area = std::abs(cross(part[k - 1] - part[0], part[k] - part[0])) / 2;
    const Vector2d middle = (part[0] + part[k - 1] + part[k]) / 3;
    sum.size += area;
    sum.nearer += area * (a.depth_at(middle) - b.depth_at(middle));
  }
}

void add_overlap(const Vector3d& from, const Vector3d& to, const Triangle& b, Overlap& sum) {
  double first = 0.0, last = 1.0;
  for (std::size_t side = 0; side < 3; ++side) {
    const double at_from = b.beyond_side(side, from.head<2>()), at_to = b.beyond_side(side, to.head<2>());
    if (at_from < 0.0 && at_to < 0.0) return;
    if (at_from < 0.0) first = std::max(first, at_from / (at_from - at_to));
    if (at_to < 0.0) last = std::min(last, at_from / (at_from - at_to));
  }
  if (last <= first) return;
  const Vector3d middle = from + (to - from) * ((first + last) / 2);
  const double length = (last - first) * (to - from).head<2>().norm();
  sum.size += length;
  sum.nearer += length * (middle.z() - b.depth_at(middle.head<2>()));
}

class Order {
 public:
  explicit Order(std::vector<DrawnFacet>& facets)
      : facets_(facets), in_front_(facets.size()), waits_for_(facets.size()) {
    Eigen::AlignedBox3d all;
    for (const DrawnFacet& facet : facets) {
      double depth = 0.0;
      Eigen::AlignedBox2d box;
      for (const Vector3d& x : facet.corners) {
        all.extend(x);
        box.extend(Vector2d(x.head<2>()));
        depth += x.z() / static_cast<double>(facet.corners.size());
      }
      boxes_.push_back(box);
      depths_.push_back(depth);
    }
    small_ = all.isEmpty() ? 0.0 : 1e-9 * all.sizes().norm();
    find_pairs();
    open_sides();
  }

  /// The numbers of the facets, in the order in which they are drawn.
  std::vector<std::uint32_t> found() {
    const auto later = [this](std::uint32_t a, std::uint32_t b) {
      return depths_[a] != depths_[b] ? depths_[a] > depths_[b] : a > b;
    };
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(later)> ready(later);
    std::vector<std::uint32_t> by_depth(facets_.size()), order;
    std::iota(by_depth.begin(), by_depth.end(), 0u);
    std::ranges::sort(by_depth, [&later](std::uint32_t a, std::uint32_t b) { return later(b, a); });
    std::vector<bool> drawn(facets_.size(), false);
    for (const std::uint32_t k : by_depth)
      if (waits_for_[k] == 0) ready.push(k);
    for (const std::uint32_t farthest : by_depth) {
      if (drawn[farthest]) continue;
      // what is left hides each other in a circle: the farthest is drawn as if nothing were behind it
      if (ready.empty()) ready.push(farthest);
      while (!ready.empty()) {
        const std::uint32_t k = ready.top();
        ready.pop();
        if (drawn[k]) continue;
        drawn[k] = true;
        order.push_back(k);
        for (const std::uint32_t other : in_front_[k])
          if (--waits_for_[other] == 0) ready.push(other);
      }
    }
    return order;
  }

 private:
  void find_pairs() {
    std::vector<std::uint32_t> from_left(facets_.size());
    std::iota(from_left.begin(), from_left.end(), 0u);
    std::ranges::stable_sort(from_left, {}, [this](std::uint32_t k) { return boxes_[k].min().x(); });
    for (std::size_t i = 0; i < from_left.size(); ++i) {
      const std::uint32_t a = from_left[i];
      for (std::size_t j = i + 1; j < from_left.size() && boxes_[from_left[j]].min().x() <= boxes_[a].max().x(); ++j) {
        const std::uint32_t b = from_left[j];
        if (boxes_[a].min().y() > boxes_[b].max().y() || boxes_[b].min().y() > boxes_[a].max().y()) continue;
        compare(a, b);
      }
    }
  }

  void compare(std::uint32_t a, std::uint32_t b) {
    if (facets_[a].corners.size() < facets_[b].corners.size()) std::swap(a, b);
    if (facets_[a].corners.size() < 3) return;  // dots and lines
    const int nearer = sign_of_nearer(facets_[b], facets_[a]);
    if (nearer > 0) put_in_front(b, a);
    if (nearer < 0) put_in_front(a, b);
  }

  void put_in_front(std::uint32_t front, std::uint32_t back) {
    in_front_[back].push_back(front);
    ++waits_for_[front];
  }

  /// A side of an obstacle that hides a tenth of the bodies' facets becomes an outline.
  void open_sides() {
    std::vector<std::size_t> hidden(facets_.size(), 0);
    std::size_t of_bodies = 0;
    for (std::size_t k = 0; k < facets_.size(); ++k) {
      if (facets_[k].of != DrawnFacet::Of::body || facets_[k].corners.size() < 2) continue;
      ++of_bodies;
      for (const std::uint32_t front : in_front_[k]) ++hidden[front];
    }
    for (std::size_t k = 0; k < facets_.size(); ++k)
      facets_[k].outline |= facets_[k].of == DrawnFacet::Of::side_of_obstacle && 10 * hidden[k] > of_bodies;
  }

  /// Is a facet in front of a polygon (1), behind it (-1), or neither?
  int sign_of_nearer(const DrawnFacet& a, const DrawnFacet& polygon) const {
    Overlap sum;
    double smallest = small_;
    for (std::size_t k = 2; k < polygon.corners.size(); ++k) {
      const Triangle b(polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]);
      if (b.area <= small_ * small_) continue;
      if (a.corners.size() == 1) {
        // a dot comes after the facets that meet in its vertex
        const Vector2d at = a.corners[0].head<2>();
        bool is_inside = true;
        for (std::size_t side = 0; side < 3; ++side) is_inside &= b.beyond_side(side, at) >= -1e-9 * b.area;
        if (is_inside) return a.corners[0].z() - b.depth_at(at) >= -1e3 * small_ ? 1 : -1;
      } else if (a.corners.size() == 2) {
        add_overlap(a.corners[0], a.corners[1], b, sum);
      } else {
        for (std::size_t l = 2; l < a.corners.size(); ++l) {
          const Triangle part(a.corners[0], a.corners[l - 1], a.corners[l]);
          if (part.area <= small_ * small_) continue;
          smallest = 1e-6 * std::min(part.area, b.area);
          add_overlap(part, b, sum);
        }
      }
    }
    if (sum.size <= smallest || std::abs(sum.nearer) <= small_ * sum.size) return 0;
    return sum.nearer > 0.0 ? 1 : -1;
  }

  std::vector<DrawnFacet>& facets_;
  std::vector<Eigen::AlignedBox2d> boxes_;
  std::vector<double> depths_;
  std::vector<std::vector<std::uint32_t>> in_front_;  // of each facet
  std::vector<std::uint32_t> waits_for_;              // the number of facets behind each that are not drawn yet
  double small_ = 0.0;                                // [m]
};

}  // namespace

void order_by_depth(std::vector<DrawnFacet>& facets) {
  std::vector<DrawnFacet> ordered;
  ordered.reserve(facets.size());
  for (const std::uint32_t k : Order(facets).found()) ordered.push_back(std::move(facets[k]));
  facets = std::move(ordered);
}

}  // namespace dartboard
