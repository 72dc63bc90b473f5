#include "core/scene/forces/faces_under_pressure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

/// Which points of the mesh are selected?
std::vector<bool> selection_of(const SceneForce& force, const Mesh& mesh) {
  std::vector<bool> selected(mesh.points.size(), false);
  for (const std::uint32_t p : select_points(force.vertices, mesh.points, force.path)) selected[p] = true;
  return selected;
}

std::vector<PressedFace> selected_faces(const SceneForce& force, const Mesh& mesh) {
  const std::vector<bool> selected = selection_of(force, mesh);
  std::vector<PressedFace> faces = outer_faces(mesh);
  std::erase_if(faces, [&selected](const PressedFace& face) {
    return !std::ranges::all_of(face.corners(), [&selected](std::uint32_t p) { return selected[p]; });
  });
  if (faces.empty())
    throw InputError(fmt::format("{}/{}: all corners of no face {} are selected; expected one at least", force.path,
                                 force.kind(), mesh.highest_dimension() == 3 ? "of the boundary" : "of a surface"));
  return faces;
}

using MeshEdge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges on the border of surfaces: of one cell alone.
std::vector<MeshEdge> border_edges(const Mesh& mesh) {
  std::map<MeshEdge, int> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (dimension(mesh.kinds[c]) != 2) continue;
    const auto corner = mesh.cell(c);
    for (std::size_t k = 0; k < corner.size(); ++k) ++cells[std::minmax(corner[k], corner[(k + 1) % corner.size()])];
  }
  std::vector<MeshEdge> border;
  for (const auto& [edge, count] : cells)
    if (count == 1) border.push_back(edge);
  return border;
}

}  // namespace

std::vector<PressedFace> faces_under_pressure(const SceneForce& force, std::uint32_t number, const Mesh& mesh) {
  double largest = force.factor.empty() ? 1.0 : 0.0;
  for (const double factor : force.factor.value) largest = std::max(largest, std::abs(factor));
  largest *= std::abs(*force.pressure);
  std::vector<PressedFace> faces = selected_faces(force, mesh);
  for (PressedFace& face : faces) {
    face.force = number;
    face.stiffness *= largest;
  }
  return faces;
}

std::vector<double> loaded_sizes(const SceneForce& force, const Mesh& mesh) {
  std::vector<double> size(mesh.points.size(), 0.0);
  if (force.shared_by == SharedBy::faces) {
    for (const PressedFace& face : selected_faces(force, mesh)) {
      std::array<Eigen::Vector3d, 4> x;
      for (std::uint32_t k = 0; k < face.count; ++k) x[k] = mesh.points[face.corner[k]];
      const auto area = forces_of_pressure(1.0, face.count, x);
      for (std::uint32_t k = 0; k < face.count; ++k) size[face.corner[k]] += area[k].norm();
    }
    return size;
  }
  const std::vector<bool> selected = selection_of(force, mesh);
  for (const auto& [a, b] : border_edges(mesh)) {
    if (!selected[a] || !selected[b]) continue;
    for (const std::uint32_t p : {a, b}) size[p] += 0.5 * (mesh.points[b] - mesh.points[a]).norm();
  }
  if (std::ranges::all_of(size, [](double s) { return s == 0.0; }))
    throw InputError(
        fmt::format("{}/{}: both ends of no edge on the border of a surface are selected; expected one at least",
                    force.path, force.kind()));
  return size;
}

std::vector<PressedFace> followed_faces(const SceneFile& scene, const Mesh& mesh) {
  std::vector<PressedFace> all;
  for (std::uint32_t f = 0; f < scene.forces.size(); ++f)
    if (scene.forces[f].follows) try {
        const auto faces = faces_under_pressure(scene.forces[f], f, mesh);
        all.insert(all.end(), faces.begin(), faces.end());
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", scene.file, error.what()));
      }
  return all;
}

}  // namespace dartboard
