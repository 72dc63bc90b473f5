#include "validation/scenes/extreme_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "reference/rebuild.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard {
namespace {

constexpr double stiffness = 100.0;  // [N/m]

SpringColumns chain(int free) {
  SpringColumns body;
  for (int i = 0; i < free + 2; ++i) body.add_vertex(1.0, {1.0 * i, 0, 0}, {0, 0, 0}, i == 0 || i == free + 1);
  for (std::uint32_t i = 0; i + 1 < body.x.size(); ++i) body.add_spring(i, i + 1, stiffness, 1.0);
  return body;
}

bool on_the_axis(const SpringColumns& body) {
  return std::ranges::all_of(body.x, [](const Eigen::Vector3d& p) { return p[1] == 0.0 && p[2] == 0.0; });
}

}  // namespace

SpringColumns extreme_body(std::string_view name) {
  if (name == "oscillator") {
    SpringColumns body = chain(0);
    body.fixed[1] = 0;
    return body;
  }
  if (name == "chain") return chain(12);
  if (name == "box") return columns_of_mesh(kuhn_box(2, 2, 2, 1.0, 0.2, 5), 1.0, stiffness);
  if (name == "sheet") return columns_of_mesh(triangle_sheet(4, 4, 1.0), 1.0, stiffness);
  throw InputError(fmt::format("there is no extreme body '{}'", name));
}

Material elastic_material(Model model, double poisson, double young) {
  return {.density = 1.0, .stiffness = 1.0, .damping = 0.0, .young = young, .poisson = poisson, .model = model};
}

SpringColumns elastic_body(std::string_view name, const Material& material, const Material& other, double thickness) {
  if (std::ranges::find(elastic_bodies, name) == std::end(elastic_bodies))
    throw InputError(fmt::format("there is no elastic body '{}'", name));
  Mesh mesh = name == "tetrahedra" ? kuhn_box(2, 1, 1, 1.0) : hexahedron_box(2, 1, 1, 1.0);
  const std::vector<Eigen::Vector3d> grid = mesh.points;
  SplitMix64 random(7);
  for (Eigen::Vector3d& p : mesh.points) p += 0.1 * random.next_in_ball();
  for (std::size_t i = 0; i < grid.size() && thickness != 1.0; ++i) {
    if (grid[i].x() <= 1.0) continue;
    const auto before = std::ranges::find(grid, Eigen::Vector3d(grid[i] - Eigen::Vector3d::UnitX())) - grid.begin();
    const Eigen::Vector3d& origin = mesh.points[static_cast<std::size_t>(before)];
    mesh.points[i] = origin + thickness * (mesh.points[i] - origin);
  }

  SpringColumns body;
  for (const Eigen::Vector3d& p : mesh.points) body.add_vertex(0.0, p);
  std::vector<MaterialNumber> of_cell;
  std::array<Mesh, 2> region;
  for (Mesh& one : region) one.points = mesh.points;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    of_cell.push_back(2 * c >= mesh.cell_count());
    region[of_cell.back()].add_cell(mesh.kinds[c], mesh.cell(c));
  }
  const std::vector materials{material, other};
  std::map<SpringEnds, Spring> springs;  // where both regions have one, they are parallel
  for (std::size_t r = 0; r < 2; ++r) {
    const reference::Rebuilt rebuilt = reference::rebuild(region[r], materials[r]);
    for (std::size_t i = 0; i < body.mass.size(); ++i) body.mass[i] += rebuilt.mass[i];
    if (materials[r].model != Model::springs) continue;
    for (const reference::Spring& s : rebuilt.springs) {
      Spring& sum = springs.try_emplace({s.a, s.b}, Spring{s.rest_length, 0.0, 0.0}).first->second;
      sum.stiffness += s.stiffness;
      sum.damping += s.damping;
    }
  }
  for (const auto& [ends, s] : springs) body.add_spring(ends[0], ends[1], s.stiffness, s.rest_length, s.damping);
  for (std::size_t i = 0; i < body.mass.size(); ++i) body.set_mass(i, body.mass[i]);
  if (material.model == Model::springs && other.model == Model::springs) return body;
  body.solid = std::make_shared<ElasticSolid>(std::move(mesh), materials, std::move(of_cell));
  body.terms = {&body.solid->term()};
  return body;
}

void set_moving(SpringColumns& body, double size, double omega) {
  SplitMix64 random(11);
  const bool line = on_the_axis(body);
  for (std::size_t i = 0; i < body.x.size(); ++i)
    for (int c = 0; c < (line ? 1 : 3); ++c) {
      const double dx = random.next_signed(), dv = random.next_signed();
      if (body.fixed[i]) continue;
      body.x[i][c] += size * dx;
      body.v[i][c] += size * omega * dv;
    }
}

}  // namespace dartboard
