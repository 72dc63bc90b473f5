#include "reference/exact_sides.h"

#include <algorithm>
#include <map>

namespace dartboard::reference {
namespace {

std::vector<WholePoint> corners(const Mesh& mesh, std::size_t c, std::span<const WholePoint> points) {
  std::vector<WholePoint> of;
  for (const std::uint32_t p : mesh.cell(c)) of.push_back(points[p]);
  return of;
}

/// The facets of a cell, each as its points, ascending.
std::vector<std::vector<std::uint32_t>> facets_of(const Mesh& mesh, std::size_t c) {
  const auto nodes = mesh.cell(c);
  std::vector<std::vector<std::uint32_t>> facets;
  for (const std::vector<int>& face : faces_of(mesh.kinds[c])) {
    if (mesh.dimension() == 3) {
      facets.emplace_back();
      for (const int k : face) facets.back().push_back(nodes[static_cast<std::size_t>(k)]);
    } else {
      for (std::size_t k = 0; k < nodes.size(); ++k) facets.push_back({nodes[k], nodes[(k + 1) % nodes.size()]});
    }
  }
  for (auto& facet : facets) std::sort(facet.begin(), facet.end());
  return facets;
}

}  // namespace

bool contains_mean(const WholeRegion& region, std::span<const WholePoint> of) {
  const auto count = static_cast<std::int64_t>(of.size());
  WholePoint sum(0, 0, 0);
  for (const WholePoint& p : of) sum += p;
  if (const auto* box = std::get_if<WholeBox>(&region))
    return (sum.array() >= count * box->min.array()).all() && (sum.array() <= count * box->max.array()).all();
  if (const auto* plane = std::get_if<WholePlane>(&region)) return (sum - count * plane->point).dot(plane->normal) >= 0;
  const auto& sphere = std::get<WholeSphere>(region);
  return (sum - count * sphere.centre).squaredNorm() <= count * count * sphere.radius * sphere.radius;
}

std::vector<std::uint32_t> cells_inside(const WholeRegion& region, const Mesh& mesh,
                                        std::span<const WholePoint> points) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
    if (contains_mean(region, corners(mesh, c, points))) cells.push_back(c);
  return cells;
}

std::set<std::vector<std::uint32_t>> facets_between(const WholePlane& plane, const Mesh& mesh,
                                                    std::span<const WholePoint> points) {
  std::map<std::vector<std::uint32_t>, int> in_front_of, cells_of;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const bool in_front = contains_mean(plane, corners(mesh, c, points));
    for (const auto& facet : facets_of(mesh, c)) {
      in_front_of[facet] += in_front;
      ++cells_of[facet];
    }
  }
  std::set<std::vector<std::uint32_t>> between;
  for (const auto& [facet, cells] : cells_of)
    if (cells == 2 && in_front_of[facet] == 1) between.insert(facet);
  return between;
}

}  // namespace dartboard::reference
