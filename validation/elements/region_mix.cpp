#include "validation/elements/region_mix.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/plain/random.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

Material operated_material(Model model, double times = 1.0) {
  return {.density = 1000.0,
          .stiffness = model == Model::springs ? times : 0.0,
          .damping = 0.0,
          .viscosity = 0.5,
          .young = 3e4 * times,
          .poisson = 0.3,
          .model = model};
}

/// The other region is twice as dense.
RegionMix mix_of(std::string name, const Material& one, Material other, bool is_attached = false) {
  other.density *= 2;
  return {std::move(name), {one, other}, is_attached};
}

Eigen::AlignedBox3d box_around(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.points) box.extend(p);
  return box;
}

}  // namespace

RegionMix uniform(Model model) { return {std::string(name(model)), {operated_material(model)}}; }

std::vector<RegionMix> region_mixes() {
  using enum Model;
  const Material soft = operated_material(springs), solid = operated_material(neo_hookean);
  return {uniform(neo_hookean),
          uniform(corotational),
          uniform(stvk),
          mix_of("neo-hookean, a part 1000 times as stiff", solid, operated_material(neo_hookean, 1e3)),
          mix_of("springs, a part 1000 times as stiff", soft, operated_material(springs, 1e3)),
          mix_of("corotational and stvk", operated_material(corotational), operated_material(stvk)),
          mix_of("springs and neo-hookean, attached", soft, solid, true)};
}

Problem problem_of(const Mesh& mesh, const RegionMix& mix) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = mix.materials.front();
  problem.surroundings.gravity.setZero();
  if (mix.materials.size() == 1) return problem;
  problem.materials = mix.materials;
  const double middle = box_around(mesh).center().x();
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    double sum = 0.0;
    for (const std::uint32_t p : mesh.cell(c)) sum += mesh.points[p].x() - middle;
    problem.cell_material.push_back(sum > 0.0);
  }
  return problem;
}

std::vector<Attachment> attachments_of(const Problem& problem, const RegionMix& mix) {
  std::vector<Attachment> attachments;
  if (!mix.is_attached) return attachments;
  const Mesh& mesh = problem.mesh;
  const auto box = box_around(mesh);
  SplitMix64 random(5);
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    const std::uint32_t c = random.below(static_cast<std::uint32_t>(mesh.cell_count()));
    const auto corners = mesh.cell(c);
    const bool is_across = mesh.points[p].x() < box.center().x() && problem.cell_material[c] == 1;
    if (!is_across || std::ranges::find(corners, p) != corners.end()) continue;
    attachments.push_back(
        {.point = p,
         .cell = c,
         .count = 4,
         .weight = {0.5, 0.25, 0.5, -0.25},
         .per_mass = 0.01 * problem.material.young / (problem.material.density * box.diagonal().squaredNorm())});
    std::copy_n(corners.begin(), 4, attachments.back().corners.begin());
  }
  return attachments;
}

std::vector<reference::Spring> springs_of(const Mesh& mesh, const CellMaterials& materials) {
  std::vector<reference::Spring> springs;
  for (std::size_t m = 0; m < materials.all().size(); ++m) {
    if (materials.all()[m].model != Model::springs) continue;
    Mesh region;
    region.points = mesh.points;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      if (materials.number(c) == m) region.add_cell(mesh.kinds[c], mesh.cell(c));
    const reference::Rebuilt rebuilt = reference::rebuild(region, materials.all()[m]);
    springs.insert(springs.end(), rebuilt.springs.begin(), rebuilt.springs.end());
  }
  return springs;
}

long double energy_of(std::span<const reference::Spring> springs, std::span<const Vector3d> x) {
  long double sum = 0.0L;
  for (const reference::Spring& s : springs) {
    const Eigen::Matrix<long double, 3, 1> line = x[s.b].cast<long double>() - x[s.a].cast<long double>();
    const long double stretch = line.norm() - static_cast<long double>(s.rest_length);
    sum += 0.5L * static_cast<long double>(s.stiffness) * stretch * stretch;
  }
  return sum;
}

}  // namespace dartboard
