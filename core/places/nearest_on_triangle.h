#pragma once
// The point of a triangle, or of two that cross, that is nearest to a place.

#include <Eigen/Core>
#include <array>
#include <optional>

namespace dartboard {

/// The point, by its weights over the corners: at least 0, and 1 together.
struct NearestOnTriangle {
  std::array<double, 3> weight{};
  Eigen::Vector3d way{0, 0, 0};  // [m] from the place to the point
};

/// The corners are relative to the place, so that its coordinates cancel once. The way is exactly along the normal if
/// the point is within the triangle, so that its direction keeps its digits however short it is. A triangle without
/// area counts as its edges.
NearestOnTriangle nearest_on_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

using TriangleCorners = std::array<Eigen::Vector3d, 3>;
/// The nearest point of the line along which two triangles cross, by its weights over the corners of the first; nothing
/// where they do not cross, or are in one plane. Corners are relative to the place.
std::optional<NearestOnTriangle> nearest_on_both(const TriangleCorners& first, const TriangleCorners& other);

}  // namespace dartboard
