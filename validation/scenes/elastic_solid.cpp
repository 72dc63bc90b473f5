#include "validation/scenes/elastic_solid.h"

#include <algorithm>
#include <cmath>

namespace dartboard {

ElasticSolid::ElasticSolid(Mesh rest, std::vector<Material> materials, std::vector<MaterialNumber> material_of)
    : rest_(std::move(rest)), materials_(std::move(materials)), material_of_(std::move(material_of)) {
  const bool tetrahedra = std::ranges::all_of(rest_.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; });
  for (std::size_t c = 0; c < rest_.cell_count(); ++c) {
    const auto nodes = rest_.cell(c);
    std::vector<Eigen::Vector3d> corners;
    for (const std::uint32_t node : nodes) corners.push_back(rest_.points[node]);
    if (tetrahedra) {
      tetrahedra_.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
      tetrahedron_shapes_.push_back(rest_shape_of(corners[0], corners[1], corners[2], corners[3]));
      cell_mass_.push_back(material(c).density * std::abs(signed_measure(rest_, c)));
    } else {
      SolidNodes& solid = solids_.emplace_back();
      solid.count = static_cast<std::uint32_t>(nodes.size());
      std::ranges::copy(nodes, solid.at.begin());
      solid_shapes_.push_back(solid_shape_of(rest_.kinds[c], corners));
    }
    if (material(c).model == Model::springs) continue;
    for (reference::ElasticPoint& point : reference::elastic_points(rest_, c, material(c)))
      points_.push_back(std::move(point));
  }
  const CellMaterials of_cells(materials_.front(), materials_, material_of_);
  term_ = tetrahedra ? make_tetrahedra(of_cells, {tetrahedra_, tetrahedron_shapes_, cell_mass_})
                     : make_solids(of_cells, {solids_, solid_shapes_});
}

bool ElasticSolid::is_like(const ElasticSolid& other) const {
  const auto same = [](const Material& a, const Material& b) {
    return a.model == b.model && a.young == b.young && a.poisson == b.poisson && a.density == b.density &&
           a.damping_time == b.damping_time;
  };
  return rest_.points == other.rest_.points && rest_.nodes == other.rest_.nodes && material_of_ == other.material_of_ &&
         std::ranges::equal(materials_, other.materials_, same);
}

}  // namespace dartboard
