#include "validation/scenes/table_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "core/scene/file/scene_materials.h"

namespace dartboard {

void add_cut(TableScene& scene, double time, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  const Mesh& mesh = scene.problem.mesh;
  const std::vector<Eigen::Vector3d> centres = centroids(mesh);
  std::vector<std::vector<std::uint32_t>> cut;
  std::map<std::vector<std::uint32_t>, bool> in_front;  // by the points of a face: is the first of its cells there?
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const bool front = (centres[c] - point).dot(normal) >= 0.0;
    for (const std::uint32_t apex : mesh.cell(c)) {
      std::vector<std::uint32_t> face;
      std::ranges::copy_if(mesh.cell(c), std::back_inserter(face), [apex](std::uint32_t k) { return k != apex; });
      std::ranges::sort(face);
      if (const auto [found, is_first] = in_front.try_emplace(face, front); !is_first && found->second != front)
        cut.push_back(face);
    }
  }
  scene.events.push_back({Dissociate{std::move(cut)}, time, time, {}, fmt::format("/events/{}", scene.events.size())});
}

void add_inclusion(TableScene& scene, const Eigen::Vector3d& place, double factor) {
  Problem& problem = scene.problem;
  const std::vector<Eigen::Vector3d> centres = centroids(problem.mesh);
  std::vector<std::uint32_t> cells(centres.size());
  std::iota(cells.begin(), cells.end(), 0u);
  std::ranges::stable_sort(cells, {}, [&](std::uint32_t c) { return (centres[c] - place).squaredNorm(); });
  cells.resize(cells.size() / 10);
  problem.materials.assign(2, problem.material);
  problem.materials[1].stiffness *= factor;
  problem.materials[1].damping *= factor;
  problem.cell_material.assign(centres.size(), 0);
  for (const std::uint32_t c : cells) {
    problem.cell_material[c] = 1;
    for (const std::uint32_t i : problem.mesh.cell(c)) {
      scene.initial_position[i] = problem.mesh.points[i];
      problem.initial_velocity[i].setZero();
    }
  }
}

void set_damping(Problem& problem, double time) {
  problem.material.damping = time * problem.material.stiffness;
  for (Material& material : problem.materials) material.damping = time * material.stiffness;
}

}  // namespace dartboard
