#pragma once
// Boxes along the axes that touch or overlap, as one solid, and the parts of their faces that are its surface.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dartboard {

/// A box along the axes, whose sides may be at infinity.
struct SpannedBox {
  Eigen::Vector3d low{0, 0, 0}, high{1, 1, 1};
  friend bool operator==(const SpannedBox&, const SpannedBox&) = default;
};

/// The way from a place to the nearest point of a surface.
struct WayToSurface {
  double distance = 0.0;           // [m]
  Eigen::Vector3d way{0, 0, 0};    // [m]
  Eigen::Vector3d point{0, 0, 0};  // its end; equal to the place along axes that the way does not follow
  int axes = 0;                    // the number of axes that it follows: 1 to a face, 2 to an edge, 3 to a corner

  /// Is it shorter, or as long to rounding and more direct?
  bool is_before(const WayToSurface& other) const {
    return distance < other.distance || (distance == other.distance && axes < other.axes);
  }
};

/// The solid that is the union of some boxes. A face of a box belongs to its surface where no other box is just beyond
/// it, so that of two faces that lie in one plane and look the same way, both do.
class JoinedBoxes {
 public:
  /// The coordinates up to which two sides count as one, over the largest coordinate of the box.
  static constexpr double tolerance = 1e-12;

  JoinedBoxes() = default;
  /// Sides that are at the same coordinate to this tolerance are put at one.
  ///
  /// cost  O(boxes^2) where few of them are next to each other
  explicit JoinedBoxes(std::vector<SpannedBox> boxes);

  std::span<const SpannedBox> boxes() const { return boxes_; }
  /// Is the place in one of the boxes, or on its faces?
  bool contains(const Eigen::Vector3d& x) const;
  /// Has the box any part of the surface?
  bool has_surface(std::size_t box) const { return first_[box] < first_[box + 1]; }
  /// The way to the nearest point of the part of the surface that this box has.
  /// pre  it has one
  WayToSurface nearest(std::size_t box, const Eigen::Vector3d& x) const;
  /// The parts of the surface that this box has: boxes without thickness.
  std::span<const SpannedBox> surface(std::size_t box) const {
    return std::span(surface_).subspan(first_[box], first_[box + 1] - first_[box]);
  }
  std::size_t bytes() const;

 private:
  std::vector<SpannedBox> boxes_, surface_;  // rectangles, in the order of boxes
  std::vector<std::size_t> first_;           // by box: its first rectangle
  SpannedBox around_;
};

/// Do the boxes have a part of a face or of their insides in common, and not just an edge, to the tolerance?
bool are_joined(const SpannedBox& a, const SpannedBox& b);

}  // namespace dartboard
