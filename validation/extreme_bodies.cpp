#include "validation/extreme_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/meshes/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/random.h"

namespace dartboard {
namespace {

constexpr double stiffness = 100.0;  // [N/m]

void add_vertex(SpringColumns& body, const Eigen::Vector3d& x, bool fixed = false) {
  body.mass.push_back(1.0);
  body.inverse_mass.push_back(1.0);
  body.viscosity.push_back(0.0);
  body.fixed.push_back(fixed);
  body.x.push_back(x);
  body.v.push_back({0, 0, 0});
}

SpringColumns chain(int free) {
  SpringColumns body;
  for (int i = 0; i < free + 2; ++i) add_vertex(body, {1.0 * i, 0, 0}, i == 0 || i == free + 1);
  for (std::uint32_t i = 0; i + 1 < body.x.size(); ++i) {
    body.ends.push_back({i, i + 1});
    body.springs.push_back({1.0, stiffness, 0.0});
  }
  return body;
}

// A spring per edge of a cell, those of neighbours added up.
SpringColumns of_mesh(const Mesh& mesh) {
  SpringColumns body;
  for (const Eigen::Vector3d& p : mesh.points) add_vertex(body, p);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j)
        ++cells[{std::min(nodes[i], nodes[j]), std::max(nodes[i], nodes[j])}];
  }
  for (const auto& [ends, count] : cells) {
    body.ends.push_back({ends.first, ends.second});
    body.springs.push_back({(body.x[ends.second] - body.x[ends.first]).norm(), stiffness * count, 0.0});
  }
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
  if (name == "box") return of_mesh(kuhn_box(2, 2, 2, 1.0, 0.2, 5));
  if (name == "sheet") return of_mesh(triangle_sheet(4, 4, 1.0));
  throw InputError(fmt::format("there is no extreme body '{}'", name));
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
