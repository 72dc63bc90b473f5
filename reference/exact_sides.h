#pragma once
// The side of a border on which a place is, if points and borders have whole coordinates: in integers, without any
// rounding.

#include <Eigen/Core>
#include <cstdint>
#include <set>
#include <span>
#include <variant>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard::reference {

using WholePoint = Eigen::Matrix<std::int64_t, 3, 1>;

struct WholeBox {
  WholePoint min, max;
};
struct WholePlane {
  WholePoint point, normal;
};
struct WholeSphere {
  WholePoint centre;
  std::int64_t radius;
};
using WholeRegion = std::variant<WholeBox, WholePlane, WholeSphere>;

/// Is the mean of some points inside a region or on its border? Fractions are multiplied out.
///
/// pre  coordinates below 1e4 and fewer than ten points, so that no product overflows
bool contains_mean(const WholeRegion& region, std::span<const WholePoint> of);

/// The numbers of the cells whose mean vertex is inside or on the border, ascending. `points` are those of the mesh.
std::vector<std::uint32_t> cells_inside(const WholeRegion& region, const Mesh& mesh,
                                        std::span<const WholePoint> points);

/// The faces, of a surface edges, of two cells that are on different sides, each as its points, ascending.
std::set<std::vector<std::uint32_t>> facets_between(const WholePlane& plane, const Mesh& mesh,
                                                    std::span<const WholePoint> points);

}  // namespace dartboard::reference
