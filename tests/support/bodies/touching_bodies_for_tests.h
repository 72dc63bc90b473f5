#pragma once
// Bodies of elements that touch each other: one mesh of several bodies, with samples and solids by its own points.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/contact/body_contact.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/plain/mesh.h"
#include "core/views/skin.h"
#include "core/views/skin_solids_view.h"

namespace dartboard {

/// All cells of one mesh after those of the other.
inline Mesh together(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (std::size_t c = 0; c < other.cell_count(); ++c) {
    std::vector<std::uint32_t> nodes(other.cell(c).begin(), other.cell(c).end());
    for (std::uint32_t& node : nodes) node += first;
    mesh.add_cell(other.kinds[c], nodes);
  }
  return mesh;
}
inline Mesh shifted(Mesh mesh, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& p : mesh.points) p += by;
  return mesh;
}

/// Samples and solids of a mesh by its own points, groups by its components in the order of their cells.
struct MeshSkin {
  std::vector<SkinSample> samples;
  SkinSolids solids;
};
template <class Map>
MeshSkin skin_of_mesh(const Mesh& mesh, const std::vector<std::uint32_t>& first_cell) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0, .stiffness = 4.0};
  auto body = build_body<Map, Held::by_every_dart>(problem);
  body.vertices.keep_rest();
  const auto& point = body.vertices.point;
  Skin samples;
  samples.rebuild(body);
  SkinSolidsView solids([&first_cell](std::uint32_t cell) {
    const auto next = std::ranges::upper_bound(first_cell, cell);
    return static_cast<std::uint32_t>(next - first_cell.begin() - 1);
  });
  solids.rebuild(body);
  MeshSkin skin;
  skin.samples = samples.samples();
  for (SkinSample& s : skin.samples)
    for (std::uint32_t k = 0; k < s.count; ++k) s.nodes[k] = point[s.nodes[k]];
  skin.solids.resize(point.size(), solids.solids().face_count(), solids.solids().cell_count());
  for (SkinTetrahedron t : solids.solids().tetrahedra()) {
    for (std::uint32_t& i : t.nodes) i = point[i];
    skin.solids.add(t);
  }
  for (SkinTriangle t : solids.solids().triangles()) {
    for (std::uint32_t& i : t.nodes) i = point[i];
    skin.solids.add(t);
  }
  return skin;
}

template <class Map>
MeshSkin skin_of_mesh(const Mesh& mesh, std::uint32_t cells_of_first) {
  return skin_of_mesh<Map>(mesh, std::vector<std::uint32_t>{0, cells_of_first});
}

inline ContactLaw law_between(int exponent, double pressure, double depth) {
  ContactLaw law;
  law.pressure = pressure;
  law.depth = depth;
  law.exponent = exponent;
  return law;
}

}  // namespace dartboard
