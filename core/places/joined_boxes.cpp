#include "core/places/joined_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/bytes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

double thickness_of(const SpannedBox& box) {
  double largest = 0.0;
  for (const Vector3d& corner : {box.low, box.high})
    for (const double c : corner)
      if (std::isfinite(c)) largest = std::max(largest, std::abs(c));
  return JoinedBoxes::tolerance * largest;
}

/// Puts the sides across an axis at one coordinate where they are next to each other.
void align(std::vector<SpannedBox>& boxes, int axis) {
  struct Side {
    double* place;
    double thickness;
  };
  std::vector<Side> sides;
  for (SpannedBox& box : boxes)
    for (double* const place : {&box.low[axis], &box.high[axis]})
      if (std::isfinite(*place)) sides.push_back({place, thickness_of(box)});
  std::ranges::stable_sort(sides, {}, [](const Side& side) { return *side.place; });
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (*sides[k].place - *sides[k - 1].place <= std::max(sides[k].thickness, sides[k - 1].thickness))
      *sides[k].place = *sides[k - 1].place;
}

/// Does the box contain the points just beyond a side of another, across an axis?
bool is_beyond(const SpannedBox& box, int axis, double side, bool above) {
  return above ? box.low[axis] <= side && side < box.high[axis] : box.low[axis] < side && side <= box.high[axis];
}

/// Adds the parts of a rectangle across an axis that are not within the box along the two others.
void add_rest(const SpannedBox& rectangle, const SpannedBox& box, int axis, std::vector<SpannedBox>& rest) {
  SpannedBox left = rectangle;
  const int others[2] = {(axis + 1) % 3, (axis + 2) % 3};
  for (const int k : others)
    if (!(box.low[k] < rectangle.high[k] && rectangle.low[k] < box.high[k])) {
      rest.push_back(rectangle);
      return;
    }
  for (const int k : others) {
    if (left.low[k] < box.low[k]) {
      rest.push_back(left);
      rest.back().high[k] = left.low[k] = box.low[k];
    }
    if (box.high[k] < left.high[k]) {
      rest.push_back(left);
      rest.back().low[k] = left.high[k] = box.high[k];
    }
  }
}

}  // namespace

JoinedBoxes::JoinedBoxes(std::vector<SpannedBox> boxes) : boxes_(std::move(boxes)) {
  for (int axis = 0; axis < 3; ++axis) align(boxes_, axis);
  first_.push_back(0);
  std::vector<SpannedBox> open, rest;
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool above : {false, true}) {
        const double side = above ? boxes_[b].high[axis] : boxes_[b].low[axis];
        if (!std::isfinite(side)) continue;
        open.assign(1, boxes_[b]);
        open[0].low[axis] = open[0].high[axis] = side;
        for (std::size_t other = 0; other < boxes_.size(); ++other) {
          if (other == b || !is_beyond(boxes_[other], axis, side, above)) continue;
          rest.clear();
          for (const SpannedBox& rectangle : open) add_rest(rectangle, boxes_[other], axis, rest);
          open.swap(rest);
        }
        surface_.insert(surface_.end(), open.begin(), open.end());
      }
    first_.push_back(surface_.size());
  }
  if (boxes_.empty()) return;
  around_ = boxes_[0];
  for (const SpannedBox& box : boxes_) {
    around_.low = around_.low.cwiseMin(box.low);
    around_.high = around_.high.cwiseMax(box.high);
  }
}

bool JoinedBoxes::contains(const Vector3d& x) const {
  const auto is_in = [&x](const SpannedBox& box) {
    return box.low[0] <= x[0] && x[0] <= box.high[0] && box.low[1] <= x[1] && x[1] <= box.high[1] &&
           box.low[2] <= x[2] && x[2] <= box.high[2];
  };
  return !boxes_.empty() && is_in(around_) && std::ranges::any_of(boxes_, is_in);
}

WayToSurface JoinedBoxes::nearest(std::size_t box, const Vector3d& x) const {
  WayToSurface found{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = first_[box]; k < first_[box + 1]; ++k) {
    WayToSurface to;
    to.point = x.cwiseMax(surface_[k].low).cwiseMin(surface_[k].high);
    to.way = to.point - x;
    to.distance = to.way.norm();
    to.axes = static_cast<int>((to.way.array() != 0.0).count());
    if (to.is_before(found)) found = to;
  }
  return found;
}

std::size_t JoinedBoxes::bytes() const { return bytes_of(boxes_, surface_, first_); }

bool are_joined(const SpannedBox& a, const SpannedBox& b) {
  const double thickness = std::max(thickness_of(a), thickness_of(b));
  int wide = 0;
  for (int k = 0; k < 3; ++k) {
    const double common = std::min(a.high[k], b.high[k]) - std::max(a.low[k], b.low[k]);
    if (common < -thickness) return false;
    if (common > thickness) ++wide;
  }
  return wide >= 2;
}

}  // namespace dartboard
