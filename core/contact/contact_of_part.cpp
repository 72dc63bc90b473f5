#include "core/contact/contact_of_part.h"

#include <algorithm>

#include "core/base/bytes.h"

namespace dartboard {
namespace {

SkinSolids solids_of_part(const SkinSolids& whole, const VertexSubset& part) {
  SkinSolids solids;
  const auto count = static_cast<std::size_t>(
      std::ranges::count_if(part.number, [](std::uint32_t k) { return k != VertexSubset::none; }));
  solids.resize(count, whole.face_count(), whole.cell_count());
  const auto add = [&](auto row) {
    if (!part.has(row.nodes[0])) return;
    for (std::uint32_t& node : row.nodes) node = part.number[node];
    solids.add(row);
  };
  for (const SkinTetrahedron& row : whole.tetrahedra()) add(row);
  for (const SkinTriangle& row : whole.triangles()) add(row);
  return solids;
}

}  // namespace

SamplesOfPart::SamplesOfPart(const std::vector<SkinSample>& of_whole, const VertexSubset& part) {
  for (std::uint32_t k = 0; k < of_whole.size(); ++k) {
    SkinSample sample = of_whole[k];
    if (!part.has(sample.nodes[0])) continue;
    for (std::size_t a = 0; a < sample.count; ++a) sample.nodes[a] = part.number[sample.nodes[a]];
    samples.push_back(sample);
    whole.push_back(k);
  }
}

ContactOfPart::ContactOfPart(const ObstacleContact* obstacles, const BodyContact* bodies, const VertexSubset& part) {
  if (obstacles != nullptr) {
    near_obstacles_ = SamplesOfPart(obstacles->samples(), part);
    const auto laws = obstacles->laws();
    const auto shapes = obstacles->obstacles();
    obstacles_ = std::make_unique<ObstacleContact>(std::vector(laws.begin(), laws.end()),
                                                   std::vector(shapes.begin(), shapes.end()), near_obstacles_.samples);
    obstacles_->place_as(*obstacles);
  }
  if (bodies != nullptr) {
    near_bodies_ = SamplesOfPart(bodies->samples(), part);
    solids_ = solids_of_part(bodies->solids(), part);
    bodies_ = std::make_unique<BodyContact>(near_bodies_.samples, solids_, *bodies);
  }
}

std::size_t ContactOfPart::bytes() const {
  return bytes_of(near_obstacles_.samples, near_obstacles_.whole, near_bodies_.samples, near_bodies_.whole) +
         solids_.bytes() + (obstacles_ ? obstacles_->bytes() : 0) + (bodies_ ? bodies_->bytes() : 0);
}

}  // namespace dartboard
