#include "core/scene/file/scene_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
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

/// Surfaces have no neo-Hookean law, and nothing but viscosity damps them; chains have no elements.
void require_elements(const SceneFile& scene, int dimension, const std::string& path, const Material& material) {
  if (dimension == 1)
    scene.fail(path + "/poisson", "is given for a chain, whose links are springs",
               "a material of its own for the chain, without this key");
  if (dimension != 2) return;
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
    if (c < mesh.cell_count() && first_loose_cell(mesh, {&c, 1}) &&
        diagonals_of(mesh.kinds[c], scene.diagonals).empty())
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

/// Chains beside obstacles have a width, and nothing else has one.
void require_widths(const SceneFile& scene, std::span<const SceneFile::Tissue> tissues,
                    const std::function<bool(std::size_t)>& is_of_a_chain) {
  for (std::size_t k = 0; k < tissues.size(); ++k) {
    const bool has_width = tissues[k].material.width > 0.0;
    if (has_width && !is_of_a_chain(k))
      scene.fail(tissues[k].path + "/width", "is given, and no chain is made of this material", "no such key");
    if (!has_width && is_of_a_chain(k) && !scene.obstacles.empty())
      scene.fail(tissues[k].path, "has no 'width', and a chain of it is beside /contact/obstacles",
                 "the width of its links [m], as that of a strip that touches them");
  }
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

void assign_materials(const SceneFile& scene, Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const std::size_t cells = mesh.cell_count(), count = cells + mesh.links.size();
  std::vector<SceneFile::Tissue> tissues = scene.tissues();
  if (tissues.size() > most_materials)
    scene.fail(tissues[most_materials].path, fmt::format("is the last of {} materials", tissues.size()),
               fmt::format("at most {}", most_materials));
  std::vector<std::size_t> tissue_of(count, 0);
  const auto give = [&tissue_of](std::size_t first, std::size_t end, std::size_t tissue) {
    std::fill(tissue_of.begin() + static_cast<std::ptrdiff_t>(first),
              tissue_of.begin() + static_cast<std::ptrdiff_t>(end), tissue);
  };
  std::size_t next = 1;
  const auto bodies = scene.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].material) continue;
    give(problem.bodies.cell[b], problem.bodies.cell[b + 1], next);
    give(cells + problem.bodies.link[b], cells + problem.bodies.link[b + 1], next);
    ++next;
  }
  for (const SceneRegion& region : scene.regions) {
    for (const std::uint32_t c : cells_of(scene, region, mesh)) tissue_of[c] = next;
    ++next;
  }

  // by the dimension of the cells, too: a tissue without 'model' may be of several
  std::map<std::pair<std::size_t, int>, std::vector<std::uint32_t>> cells_of_material;
  const auto material_of = [&](std::uint32_t c) {
    return std::pair(tissue_of[c], c < cells ? -dimension(mesh.kinds[c]) : -1);
  };
  if (count == 0) cells_of_material[{0, 0}] = {};
  for (std::uint32_t c = 0; c < count; ++c) cells_of_material[material_of(c)].push_back(c);
  std::map<std::pair<std::size_t, int>, MaterialNumber> number_of;
  for (const auto& [key, own] : cells_of_material) {
    const SceneFile::Tissue& tissue = tissues[key.first];
    Material material = tissue.material;
    material.model = model_of(tissue, -key.second);
    if (material.model != Model::springs)
      require_elements(scene, -key.second, tissue.path, material);
    else if (material.young > 0.0)
      material.stiffness = stiffness_of_young(scene, mesh, tissue, own);
    number_of[key] = static_cast<MaterialNumber>(problem.materials.size());
    problem.materials.push_back(material);
    problem.materials.back().viscosity = scene.material.viscosity;
  }
  require_widths(scene, tissues, [&](std::size_t tissue) { return cells_of_material.contains({tissue, -1}); });
  problem.material = problem.materials.front();
  if (problem.materials.size() == 1) {
    problem.materials.clear();
    return;
  }
  for (std::uint32_t c = 0; c < count; ++c) problem.cell_material.push_back(number_of.at(material_of(c)));
}

}  // namespace dartboard
