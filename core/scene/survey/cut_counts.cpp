#include "core/scene/survey/cut_counts.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "core/places/border.h"
#include "core/scene/file/scene_materials.h"

namespace dartboard {
namespace {

using Points = std::vector<std::uint32_t>;

/// Faces of volumes, edges of polygons.
std::vector<Points> facets_of(const Mesh& mesh, std::size_t cell) {
  const auto nodes = mesh.cell(cell);
  std::vector<Points> facets;
  if (dimension(mesh.kinds[cell]) == 3)
    for (const std::vector<int>& face : faces_of(mesh.kinds[cell])) {
      facets.emplace_back();
      for (const int k : face) facets.back().push_back(nodes[static_cast<std::size_t>(k)]);
    }
  else
    for (std::size_t k = 0; k < nodes.size(); ++k) facets.push_back({nodes[k], nodes[(k + 1) % nodes.size()]});
  return facets;
}

Eigen::Vector3d centre(const Mesh& mesh, const Points& points) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const std::uint32_t p : points) sum += mesh.points[p];
  return sum / static_cast<double>(points.size());
}

/// Facets between cells on two sides of the plane that are no farther than `near` from the bounds, and farther than the
/// borders are thick.
std::size_t just_outside(const PlaneSelection& plane, const CutRegion& within, const Mesh& mesh, double thickness,
                         double near) {
  const std::vector<Eigen::Vector3d> at = centroids(mesh);
  std::map<Points, std::size_t> first_cell;  // of each facet
  std::size_t count = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (Points& points : facets_of(mesh, c)) {
      const Eigen::Vector3d x = centre(mesh, points);
      std::ranges::sort(points);
      const auto [found, is_first] = first_cell.try_emplace(std::move(points), c);
      if (is_first || contains(plane, at[found->second], thickness) == contains(plane, at[c], thickness)) continue;
      count += contains(within, x, near) && !contains(within, x, thickness);
    }
  return count;
}

}  // namespace

std::size_t count_inner_facets(const Mesh& mesh) {
  std::set<Points> facets;
  std::size_t of_cells = 0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (Points& points : facets_of(mesh, c)) {
      std::ranges::sort(points);
      facets.insert(std::move(points));
      ++of_cells;
    }
  return of_cells - facets.size();
}

SelectionCount count_cut(const SceneEvent& event, const Mesh& mesh, std::size_t selected, std::size_t all) {
  const auto& cut = std::get<Dissociate>(event.action);
  const double thickness = border_thickness(mesh.points);
  SelectionCount count{.path = event.path + "/dissociate",
                       .of_what = is_mixed(mesh)                  ? "faces and edges between cells"
                                  : mesh.highest_dimension() == 3 ? "faces between cells"
                                                                  : "edges between faces",
                       .selected = selected,
                       .all = all,
                       .near = 10.0 * thickness,
                       .moves = !std::holds_alternative<FacetPoints>(cut.faces)};
  const auto* plane = std::get_if<PlaneSelection>(&cut.faces);
  if (plane != nullptr && cut.within)
    count.just_outside = just_outside(*plane, *cut.within, mesh, thickness, count.near);
  return count;
}

}  // namespace dartboard
