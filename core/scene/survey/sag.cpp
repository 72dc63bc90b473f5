#include "core/scene/survey/sag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/plain/extent.h"

namespace dartboard {
namespace {

bool is_held(const Problem& problem, std::size_t first, std::size_t end) {
  const auto is_of_body = [first, end](std::size_t point) { return point >= first && point < end; };
  return std::ranges::any_of(problem.fixed, is_of_body) ||
         std::ranges::any_of(problem.held_axes, is_of_body, &HeldPoint::point);
}

}  // namespace

std::string to_string(const Sag& sag) {
  return fmt::format(
      "{}: its weight is expected to compress or stretch it by {:.2g} times its height of {:.3g} m; 'young' is in pascals "
      "(N/m for a surface){}",
      sag.path, sag.strain, sag.height,
      sag.is_as_in_file ? ", and a mesh in millimetres needs a 'scale' of 0.001" : "");
}

std::vector<Sag> find_sags(const SceneFile& scene, const Problem& problem) {
  std::vector<Sag> found;
  const double gravity = problem.surroundings.gravity.norm();
  if (!(gravity > 0.0)) return found;
  const CellMaterials materials = problem.cell_materials();
  const auto bodies = scene.bodies();
  const BodyRanges& ranges = problem.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool has_support = scene.has_contact() || !scene.attachments.empty();
    if (!has_support && !is_held(problem, ranges.point[b], ranges.point[b + 1])) continue;
    double softness = 0.0;
    for (std::size_t c = ranges.cell[b]; c < ranges.cell[b + 1]; ++c)
      if (materials[c].young > 0.0) softness += materials[c].density / materials[c].young;
    if (softness == 0.0) continue;
    softness /= static_cast<double>(ranges.cell[b + 1] - ranges.cell[b]);
    const double height =
        extent_along(problem.surroundings.gravity / gravity,
                     std::span(problem.mesh.points).subspan(ranges.point[b], ranges.point[b + 1] - ranges.point[b]));
    const double strain = softness * gravity * height / 2.0;
    if (strain > 1.0)
      found.push_back({bodies[b].path, height, strain, bodies[b].loaded != nullptr && bodies[b].scale == 1.0});
  }
  return found;
}

}  // namespace dartboard
