#include "core/scene/file/scene_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/young.h"
#include "core/places/border.h"
#include "core/scene/file/cell_tags.h"
#include "core/scene/file/selections/selection.h"
#include "core/scene/file/springs_beside_edges.h"

namespace dartboard {
namespace {

/// The numbers of the cells of a region, at rest.
std::vector<std::uint32_t> cells_of(const SceneFile& scene, const SceneRegion& region, const Mesh& mesh) {
  const std::string path = region.path + "/cells";
  std::vector<std::uint32_t> cells;
  if (const auto* tag = std::get_if<TagSelection>(&region.cells)) {
    cells = cells_with(scene, *tag, path + "/tag");
  } else if (const auto* by_id = std::get_if<IdSelection>(&region.cells)) {
    for (std::size_t k = 0; k < by_id->ids.size(); ++k)
      if (by_id->ids[k] >= mesh.cell_count())
        scene.fail(fmt::format("{}/ids/{}", path, k), fmt::format("is {}", by_id->ids[k]),
                   fmt::format("a cell of the mesh, less than {}", mesh.cell_count()));
    cells = by_id->ids;
  } else {
    cells = cells_in(region.cells, centroids(mesh), border_thickness(mesh.points));
  }
  if (cells.empty()) scene.fail(path, "selects no cell of the body", "a region that some cells have their centroid in");
  return cells;
}

/// Surfaces have no neo-Hookean law, and nothing but viscosity damps them.
void require_elements(const SceneFile& scene, const Mesh& mesh, const std::string& path, const Material& material) {
  if (mesh.dimension() != 2) return;
  if (material.model == Model::neo_hookean)
    scene.fail(
        path + "/model", fmt::format("is \"{}\", and the body is a surface", name(material.model)),
        fmt::format("\"{}\", \"{}\" or \"{}\"", name(Model::stvk), name(Model::corotational), name(Model::springs)));
  if (material.damping_time > 0.0)
    scene.fail(path + "/damping", "is a ratio at a frequency, and the body is a surface",
               "no such key: only 'viscosity' damps membranes");
}

/// The mean stiffness of the edges of some cells that follows from a Young's modulus.
double stiffness_of_young(const SceneFile& scene, const Mesh& mesh, const SceneFile::Tissue& tissue,
                          std::span<const std::uint32_t> cells) {
  const auto wrong = [&](std::string_view found, std::string_view expected) {
    scene.fail(tissue.path + "/young", fmt::format("is {} Pa, and {}", tissue.material.young, found), expected);
  };
  for (const std::uint32_t c : cells)
    if (first_loose_cell(mesh, {&c, 1}) && diagonals_of(mesh.kinds[c], scene.diagonals).empty())
      wrong(fmt::format("cell {} is a {}, whose edges alone do not hold its shape", c, name(mesh.kinds[c])),
            "tetrahedra, triangles or a chain, /diagonals together with it, or 'stiffness' in its place");
  const double mean = scene.diagonals == Diagonals::none
                          ? mean_stiffness(mesh, tissue.material.young, cells)
                          : mean_stiffness_beside(mesh, tissue.material.young, cells, scene.diagonals);
  if (!(mean > 0.0 && std::isfinite(mean)))
    wrong(fmt::format("the stiffness of its springs has a mean of {:.6g} N/m", mean),
          "a number above 0, of edges that have a length and cells that have a volume");
  return mean;
}

}  // namespace

Model model_of(const SceneFile::Tissue& tissue, int dimension) {
  const Model model = tissue.material.model;
  return dimension == 2 && !tissue.names_model && model != Model::springs ? Model::stvk : model;
}

Eigen::Vector3d centroid(const Mesh& mesh, std::size_t c) {
  Eigen::Vector3d sum(0, 0, 0);
  for (const std::uint32_t p : mesh.cell(c)) sum += mesh.points[p];
  return sum / static_cast<double>(mesh.cell(c).size());
}

std::vector<Eigen::Vector3d> centroids(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> all;
  all.reserve(mesh.cell_count());
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) all.push_back(centroid(mesh, c));
  return all;
}

void assign_materials(const SceneFile& scene, std::span<const std::size_t> first_cell, Problem& problem) {
  const std::size_t count = problem.mesh.cell_count();
  std::vector<SceneFile::Tissue> tissues = scene.tissues();
  if (tissues.size() > most_materials)
    scene.fail(tissues[most_materials].path, fmt::format("is the last of {} materials", tissues.size()),
               fmt::format("at most {}", most_materials));
  std::vector<std::size_t> tissue_of(count, 0);
  std::size_t next = 1;
  const auto bodies = scene.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].material) continue;
    const std::size_t end = b + 1 < bodies.size() ? first_cell[b + 1] : count;
    std::fill(tissue_of.begin() + static_cast<std::ptrdiff_t>(first_cell[b]),
              tissue_of.begin() + static_cast<std::ptrdiff_t>(end), next++);
  }
  for (const SceneRegion& region : scene.regions) {
    for (const std::uint32_t c : cells_of(scene, region, problem.mesh)) tissue_of[c] = next;
    ++next;
  }

  std::vector<std::vector<std::uint32_t>> cells(tissues.size());
  for (std::uint32_t c = 0; c < count; ++c) cells[tissue_of[c]].push_back(c);
  const bool has_cells = count > 0;
  std::vector<MaterialNumber> number_of(tissues.size());
  for (std::size_t t = 0; t < tissues.size(); ++t) {
    if (has_cells && cells[t].empty()) continue;
    Material& material = tissues[t].material;
    material.model = model_of(tissues[t], problem.mesh.dimension());
    if (material.model != Model::springs)
      require_elements(scene, problem.mesh, tissues[t].path, material);
    else if (material.young > 0.0)
      material.stiffness = stiffness_of_young(scene, problem.mesh, tissues[t], cells[t]);
    number_of[t] = static_cast<MaterialNumber>(problem.materials.size());
    problem.materials.push_back(material);
    problem.materials.back().viscosity = scene.material.viscosity;
  }
  problem.material = problem.materials.front();
  if (problem.materials.size() == 1) {
    problem.materials.clear();
    return;
  }
  for (const std::size_t t : tissue_of) problem.cell_material.push_back(number_of[t]);
}

}  // namespace dartboard
