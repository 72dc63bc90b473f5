#include "core/scene/body/faces_under_pressure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard {
std::vector<PressedFace> faces_under_pressure(const SceneForce& force, std::uint32_t number, const Mesh& mesh) {
  std::vector<bool> selected(mesh.points.size(), false);
  for (const std::uint32_t p : select_points(force.vertices, mesh.points, force.path)) selected[p] = true;
  double largest = force.factor.empty() ? 1.0 : 0.0;
  for (const double factor : force.factor.value) largest = std::max(largest, std::abs(factor));
  largest *= std::abs(*force.pressure);
  std::vector<PressedFace> faces;
  for (PressedFace face : outer_faces(mesh)) {
    if (!std::ranges::all_of(face.corners(), [&selected](std::uint32_t p) { return selected[p]; })) continue;
    face.force = number;
    face.stiffness *= largest;
    faces.push_back(face);
  }
  if (faces.empty())
    throw InputError(fmt::format("{}/pressure: all corners of no face {} are selected; expected one at least",
                                 force.path, mesh.highest_dimension() == 3 ? "of the boundary" : "of a surface"));
  return faces;
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
