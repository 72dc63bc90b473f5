#include "validation/scenes/extreme_bodies.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
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

SpringColumns elastic_body(std::string_view name, const Material& material, const Material& other) {
  if (std::ranges::find(elastic_bodies, name) == std::end(elastic_bodies))
    throw InputError(fmt::format("there is no elastic body '{}'", name));
  Mesh mesh = name == "tetrahedra" ? kuhn_box(2, 1, 1, 1.0) : hexahedron_box(2, 1, 1, 1.0);
  SplitMix64 random(7);
  for (Eigen::Vector3d& p : mesh.points) p += 0.1 * random.next_in_ball();
  SpringColumns body;
  for (const Eigen::Vector3d& p : mesh.points) body.add_vertex(0.0, p);
  std::vector<MaterialNumber> of_cell;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    of_cell.push_back(2 * c >= mesh.cell_count());
    const auto nodes = mesh.cell(c);
    const double density = (of_cell.back() == 0 ? material : other).density;
    for (const std::uint32_t node : nodes)
      body.mass[node] += density * signed_measure(mesh, c) / static_cast<double>(nodes.size());
  }
  for (std::size_t i = 0; i < body.mass.size(); ++i) body.set_mass(i, body.mass[i]);
  body.solid = std::make_shared<ElasticSolid>(std::move(mesh), std::vector{material, other}, std::move(of_cell));
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
