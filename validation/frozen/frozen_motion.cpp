#include "validation/frozen/frozen_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/cell_materials.h"
#include "core/plain/nan_maximum.h"
#include "core/scene/file/force_kind.h"
#include "reference/rebuild.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The mesh of the cells of a body now, with every vertex at the rest position of its mesh point.
Mesh mesh_at_rest(const FrozenScene& scene, const Frame& frame) {
  Mesh mesh = frame.mesh;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    mesh.points[k] = scene.problem.mesh.points[static_cast<std::size_t>(frame.mesh_point[k])];
  return mesh;
}

/// The cells of one material; all points.
Mesh cells_of(const Mesh& mesh, const CellMaterials& materials, const std::vector<std::uint32_t>& mesh_cell,
              MaterialNumber number) {
  Mesh part;
  part.points = mesh.points;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (materials.number(mesh_cell[c]) == number) part.add_cell(mesh.kinds[c], mesh.cell(c));
  return part;
}

void add_links(const Problem& problem, reference::SpringNetwork& network) {
  const Material& material = problem.material;
  const auto& points = problem.mesh.points;
  for (const auto& [a, b] : problem.mesh.links) {
    const double length = (points[b] - points[a]).norm();
    const double share = material.young > 0.0 ? material.young / length / material.stiffness : 1.0;
    network.springs.push_back({a, b, share * material.stiffness, share * material.damping, length});
    for (const std::uint32_t end : {a, b}) network.mass[end] += material.density * length / 2;
  }
}

void add_cells(const FrozenScene& scene, const Frame& frame, reference::SpringNetwork& network) {
  const Mesh mesh = mesh_at_rest(scene, frame);
  const CellMaterials materials = scene.problem.cell_materials();
  const auto all = materials.all();
  for (std::size_t number = 0; number < all.size(); ++number) {
    const Mesh part = cells_of(mesh, materials, frame.mesh_cell, static_cast<MaterialNumber>(number));
    if (part.cell_count() == 0) continue;
    reference::Rebuilt rebuilt = reference::rebuild(part, all[number]);
    for (std::size_t k = 0; k < rebuilt.mass.size(); ++k) network.mass[k] += rebuilt.mass[k];
    if (all[number].model == Model::springs) {
      network.springs.insert(network.springs.end(), rebuilt.springs.begin(), rebuilt.springs.end());
      continue;
    }
    for (std::size_t c = 0; c < part.cell_count(); ++c)
      for (reference::ElasticPoint& point : reference::elastic_points(part, c, all[number]))
        network.elements.push_back(std::move(point));
  }
}

/// Positions that identify the vertex they come from when they are copied or averaged: (k, k^2, 0) for vertex k.
void mark_places(std::span<Vector3d> x) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = Vector3d(static_cast<double>(k), static_cast<double>(k * k), 0.0);
}

/// For a copy, the vertex itself; for a vertex that refinement has put between two, the first of them.
std::uint32_t origin_of(const Vector3d& x, std::size_t vertices) {
  const double k = std::round(x.x() - std::sqrt(std::max(0.0, x.y() - x.x() * x.x())));
  return static_cast<std::uint32_t>(std::clamp(k, 0.0, static_cast<double>(vertices - 1)));
}

}  // namespace

std::string beyond_references(const SceneFile& file, const Mesh& mesh) {
  if (is_mixed(mesh)) return "bodies of several dimensions";
  if (file.has_contact()) return "contact";
  if (changes_in_every_step(file)) return "loads that change in time";
  if (file.diagonals != Diagonals::none) return "springs that are no edges";
  for (const ForceKind& kind : force_kinds())
    if (kind.is_in(file)) return std::string(kind.name);
  if (file.has_elements() && mesh.dimension() == 2) return "membranes";
  const auto known = [](CellKind kind) { return kind == CellKind::tetrahedron || kind == CellKind::hexahedron; };
  if (file.has_elements() && !std::ranges::all_of(mesh.kinds, known)) return "elements of these cells";
  if (has<Refine>(file.events)) return "refinement";
  return {};
}

double mean_edge(const Mesh& mesh) {
  reference::SpringNetwork edges;
  if (mesh.cell_count() > 0) edges.springs = reference::rebuild(mesh, Material{}).springs;
  for (const auto& [a, b] : mesh.links)
    edges.springs.push_back({a, b, 0.0, 0.0, (mesh.points[b] - mesh.points[a]).norm()});
  return reference::mean_rest_length(edges);
}

reference::SpringNetwork network_of(const FrozenScene& scene, const SimulatedBody& body) {
  const VertexColumns& v = body.vertices();
  reference::SpringNetwork network;
  network.edge = scene.edge;
  if (!beyond_references(scene.file, scene.problem.mesh).empty()) {
    network.mass.assign(v.mass.begin(), v.mass.end());
  } else {
    network.mass.assign(v.size(), 0.0);
    scene.problem.mesh.cell_count() == 0 ? add_links(scene.problem, network)
                                         : add_cells(scene, body.frame({}), network);
  }
  network.fixed.assign(v.fixed.begin(), v.fixed.end());
  network.fixed.resize(v.size(), 0);
  network.held_axes.assign(v.held_axes.begin(), v.held_axes.end());
  network.pull.assign(v.pull.begin(), v.pull.end());
  network.viscosity = scene.problem.material.viscosity;
  network.gravity = scene.problem.surroundings.gravity;
  return network;
}

FrozenMotion motion_of(const FrozenScene& scene, std::size_t checkpoints) {
  FrozenBody moved(scene);
  SimulatedBody& body = moved.body();
  FrozenMotion made;
  reference::NetworkMotion& motion = made.motion;
  const bool is_beyond = !beyond_references(scene.file, scene.problem.mesh).empty();
  const auto network_now = [&] {
    reference::SpringNetwork network = network_of(scene, body);
    if (is_beyond) return network;
    std::vector<Vector3d> at_rest;
    for (const std::uint32_t point : body.vertices().point) at_rest.push_back(scene.problem.mesh.points[point]);
    made.fastest_rate = max_or_nan(made.fastest_rate, reference::fastest_rate(network, at_rest));
    return network;
  };
  motion.network = network_now();
  const Motion start = body.motion();
  motion.start = {{start.x.begin(), start.x.end()}, {start.v.begin(), start.v.end()}};
  for (std::size_t c = 1; c <= checkpoints; ++c)
    motion.checkpoints.push_back(scene.file.duration * static_cast<double>(c) / static_cast<double>(checkpoints));
  for (const FrozenChange& change : scene.changes) {
    if (change.time == 0.0) continue;
    const std::size_t before = body.vertices().size();
    mark_places(body.motion().x);
    moved.pass();
    reference::NetworkEvent event{.time = change.time, .network = network_now(), .from = {}};
    for (const Vector3d& x : body.motion().x) event.from.push_back(origin_of(x, before));
    // the other vertices keep the velocities that they have by then
    for (std::uint32_t k = 0; k < event.network.point_count(); ++k)
      if (event.network.fixed[k] != 0) event.drives.push_back({k, body.motion().v[k]});
    motion.events.push_back(std::move(event));
  }
  if (is_beyond) {
    FrozenBody at_start(scene);
    made.fastest_rate = at_start.fastest_rate();
    for (std::size_t k = 0; k < motion.events.size(); ++k) {
      at_start.pass();
      made.fastest_rate = max_or_nan(made.fastest_rate, at_start.fastest_rate());
    }
  }
  check(motion);
  return made;
}

}  // namespace dartboard
