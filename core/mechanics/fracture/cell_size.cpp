#include "core/mechanics/fracture/cell_size.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// An order of places that does not depend on the numbers of corners.
bool is_before(const Vector3d& a, const Vector3d& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

/// The corners in that order. Nothing here branches on which of two is before the other: it could not be predicted.
template <std::size_t n>
std::array<const Vector3d*, n> in_order(std::span<const Vector3d> corners) {
  std::array<const Vector3d*, n> x;
  std::size_t places = 0;  // a bit for each that is taken
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t place = 0;
    for (std::size_t other = 0; other < n; ++other) place += corners[other].x() < corners[k].x();
    x[place] = &corners[k];
    places |= std::size_t{1} << place;
  }
  if (places == (std::size_t{1} << n) - 1) return x;  // as nearly always: no two have the same x
  for (std::size_t k = 0; k < n; ++k) x[k] = &corners[k];
  for (std::size_t end = n - 1; end > 0; --end)
    for (std::size_t k = 0; k < end; ++k) {
      const Vector3d *const a = x[k], *const b = x[k + 1];
      const bool exchanged = is_before(*b, *a);
      x[k] = exchanged ? b : a;
      x[k + 1] = exchanged ? a : b;
    }
  return x;
}

double triangle_area(std::span<const Vector3d> corners) {
  const auto x = in_order<3>(corners);
  return 0.5 * (*x[1] - *x[0]).cross(*x[2] - *x[0]).norm();
}

double tetrahedron_volume(std::span<const Vector3d> corners) {
  const auto x = in_order<4>(corners);
  return std::abs((*x[1] - *x[0]).cross(*x[2] - *x[0]).dot(*x[3] - *x[0])) / 6.0;
}

/// The area of a quadrilateral, which may be skew: the length of its vector area, half of the product of its diagonals.
double quadrilateral_area(std::span<const Vector3d> x) { return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm(); }

/// A third of the sum over the faces of their middle times their vector area, from the lowest corner. Each face is
/// walked from its own lowest corner. The terms of the faces are summed by size, each sign by itself.
double solid_volume(CellKind kind, std::span<const Vector3d> x) {
  const Vector3d origin = *std::min_element(x.begin(), x.end(), is_before);
  std::array<double, 6> parts{};  // of the faces, by size
  std::size_t count = 0;
  for (const std::vector<int>& face : faces_of(kind)) {
    std::array<Vector3d, 4> p;
    p.fill(origin);
    std::size_t n = 0;
    for (const int corner : face) p[n++] = x[static_cast<std::size_t>(corner)];
    const auto end = p.begin() + static_cast<std::ptrdiff_t>(n);
    std::rotate(p.begin(), std::min_element(p.begin(), end, is_before), end);
    const double part = n == 3 ? (p[0] - origin).dot((p[1] - p[0]).cross(p[2] - p[0]))
                               : 0.25 * (((p[0] - origin) + (p[2] - origin)) + ((p[1] - origin) + (p[3] - origin)))
                                            .dot((p[2] - p[0]).cross(p[3] - p[1]));
    std::size_t at = count++;
    for (; at > 0 && std::abs(part) < std::abs(parts[at - 1]); --at) parts[at] = parts[at - 1];
    parts[at] = part;
  }
  double outward = 0.0, inward = 0.0;
  for (const double part : parts) (part > 0.0 ? outward : inward) += part;
  return std::abs(outward + inward) / 6.0;
}

}  // namespace

double cell_size(CellKind kind, std::span<const Vector3d> corners) {
  switch (kind) {
    case CellKind::triangle: return triangle_area(corners);
    case CellKind::quadrilateral: return quadrilateral_area(corners);
    case CellKind::tetrahedron: return tetrahedron_volume(corners);
    default: return solid_volume(kind, corners);
  }
}

CellKind kind_of_corners(int dimension, std::size_t corners) {
  if (dimension == 2) return corners == 3 ? CellKind::triangle : CellKind::quadrilateral;
  return corners == 4   ? CellKind::tetrahedron
         : corners == 5 ? CellKind::pyramid
         : corners == 6 ? CellKind::prism
                        : CellKind::hexahedron;
}

}  // namespace dartboard
