#include "reference/cgal/overlaps.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/plain/error.h"
#include "reference/least_translation.h"

namespace dartboard::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Tetrahedron = Kernel::Tetrahedron_3;

struct NumberedBox : CGAL::Box_intersection_d::Box_d<double, 3> {
  NumberedBox(const CGAL::Bbox_3& box, std::uint32_t k) : Box_d(box), number(k) {}
  std::uint32_t number;
};

TetrahedronCorners corners_of(std::span<const Eigen::Vector3d> x, const std::array<std::uint32_t, 4>& t) {
  return {x[t[0]], x[t[1]], x[t[2]], x[t[3]]};
}

bool share_a_corner(const std::array<std::uint32_t, 4>& a, const std::array<std::uint32_t, 4>& b) {
  return std::ranges::any_of(a, [&b](std::uint32_t k) { return std::ranges::find(b, k) != b.end(); });
}

}  // namespace

std::vector<Overlap> overlaps(std::span<const Eigen::Vector3d> x,
                              std::span<const std::array<std::uint32_t, 4>> tetrahedra) {
  std::vector<Tetrahedron> solid;
  std::vector<NumberedBox> boxes;
  solid.reserve(tetrahedra.size());
  for (std::uint32_t k = 0; k < tetrahedra.size(); ++k) {
    std::array<Point, 4> p;
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint32_t i = tetrahedra[k][a];
      if (i >= x.size())
        throw InputError(fmt::format("tetrahedron {} has corner {}; expected one of {} places", k, i, x.size()));
      if (!x[i].allFinite()) throw InputError(fmt::format("place {} is not finite", i));
      p[a] = {x[i].x(), x[i].y(), x[i].z()};
    }
    solid.emplace_back(p[0], p[1], p[2], p[3]);
    if (!solid.back().is_degenerate()) boxes.emplace_back(solid.back().bbox(), k);
  }

  std::vector<Overlap> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const NumberedBox& a, const NumberedBox& b) {
    const auto [first, second] = std::minmax(a.number, b.number);
    if (share_a_corner(tetrahedra[first], tetrahedra[second])) return;
    if (!CGAL::do_intersect(solid[first], solid[second])) return;
    const Translation apart = least_translation(corners_of(x, tetrahedra[first]), corners_of(x, tetrahedra[second]));
    found.push_back({first, second, apart.depth, apart.along});
  });
  std::ranges::sort(found, {}, [](const Overlap& o) { return std::tuple(o.first, o.second); });
  return found;
}

}  // namespace dartboard::reference
