#include "validation/elements/bar_of_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/scene/file/force_kind.h"
#include "core/scene/file/scene_problem.h"

namespace dartboard {
namespace {

/// The points at one end of a box of unit cubes, ascending.
std::vector<std::uint32_t> end_of(const Mesh& box, std::size_t axis, double at) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t p = 0; p < box.points.size(); ++p)
    if (std::abs(box.points[p][static_cast<Eigen::Index>(axis)] - at) < 0.25) found.push_back(p);
  return found;
}

Mesh unit_box(const BoxMesh& box) {
  const auto [nx, ny, nz] = box.cells;
  if (box.kind == "hexahedra") return hexahedron_box(nx, ny, nz, 1.0);
  if (box.kind == "mixed") return mixed_box(nx, ny, nz, 1.0);
  return kuhn_box(nx, ny, nz, 1.0);
}

}  // namespace

BarOfScene bar_of_scene(const SceneFile& scene) {
  const auto fail = [&](std::string_view path, std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}: {}: {}; expected {}", scene.file, path, found, expected));
  };
  const auto* box = std::get_if<BoxMesh>(&scene.body.mesh);
  if (box == nullptr) fail("/body", "is no generated box", "\"generate\": {\"box\": ...}, a bar of cubes");
  if (const auto tissues = scene.tissues(); tissues.size() > 1)
    fail(tissues[1].path, "is one material of several", "a bar of one");
  if (!(scene.material.young > 0.0))
    fail("/material/young", "is missing", "a Young's modulus [Pa], which every model can be given");
  if (!scene.driven.empty()) fail("/driven", "moves vertices", "a bar held at one end, and no more");
  if (!scene.forces.empty()) fail("/forces", "pulls at vertices", "a bar under its own weight");
  for (const ForceKind& kind : force_kinds())
    if (kind.is_in(scene)) fail(fmt::format("/{}", kind.name), "is a force", "a bar held at one end, and no more");
  if (scene.has_contact()) fail("/contact", "says what touches", "a bar that touches nothing");

  const std::vector<std::uint32_t> fixed = [&] {
    SceneFile points_alone = scene;  // without the stiffness of springs, which not all cells have
    points_alone.material.model = Model::springs;
    points_alone.material.young = 0.0;
    return make_problem(points_alone).fixed;
  }();
  const Mesh cubes = unit_box(*box);
  std::size_t along = 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double at : {0.0, static_cast<double>(box->cells[axis])})
      if (fixed == end_of(cubes, axis, at)) along = axis;
  if (along == 3)
    fail("/fixed", fmt::format("holds {} of the {} points of the box", fixed.size(), cubes.points.size()),
         "all points of one of its six sides and no others, as a \"plane\" selects them");

  BarOfScene made;
  const int largest = std::gcd(std::gcd(box->cells[0], box->cells[1]), box->cells[2]);
  std::array<int, 3> cells = box->cells;
  std::swap(cells[0], cells[along]);
  for (int& n : cells) n /= largest;
  made.bar = {cells, box->spacing * scene.body.scale * largest, scene.material.young, scene.material.density};
  if (made.bar.cubes[0] < 2 * std::max(made.bar.cubes[1], made.bar.cubes[2]))
    fail("/body/generate/box/cells",
         fmt::format("make a box of {} x {} x {} cubes along its held axis and across", cells[0], cells[1], cells[2]),
         "a bar at least twice as long as it is wide");
  made.poisson = scene.has_elements() ? scene.material.poisson : 0.25;
  const auto omit = [&](bool there, std::string_view what) {
    if (there) made.omissions.push_back(fmt::format("{} left out: the bar is bent by its end and let go of.", what));
  };
  omit(!scene.gravity.isZero(), "Gravity is");
  omit(scene.material.damping > 0.0 || scene.material.viscosity > 0.0, "Damping and viscosity are");
  omit(!scene.events.empty(), "Events are");
  omit(scene.sleep.has_value(), "Sleep is");
  if (box->kind == "tetrahedra" && box->pattern == "mirrored")
    made.omissions.emplace_back(
        "Cubes are cut into tetrahedra alike, \"pattern\": \"kuhn\": mirror images are not among the models.");
  return made;
}

}  // namespace dartboard
