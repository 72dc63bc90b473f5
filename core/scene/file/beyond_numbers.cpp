#include "core/scene/file/beyond_numbers.h"
#include "core/scene/file/force_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dartboard {
namespace {

struct Magnitude {
  std::string path;
  double value;

  double decades() const { return value == 0.0 ? 0.0 : std::abs(std::log10(value)); }
};

Magnitude size_of(const BodySource& body, const Mesh& mesh) {
  if (const auto* box = std::get_if<BoxMesh>(&body.mesh)) return {body.path + "/generate/box/spacing", box->spacing};
  if (const auto* sheet = std::get_if<SheetMesh>(&body.mesh))
    return {body.path + "/generate/sheet/spacing", sheet->spacing};
  if (const auto* ball = std::get_if<BallMesh>(&body.mesh)) return {body.path + "/generate/ball/radius", ball->radius};
  if (const auto* chain = std::get_if<ChainMesh>(&body.mesh))
    return {body.path + "/generate/chain/spacing", chain->spacing};
  double largest = 0.0;  // in the file, before the mesh is scaled and moved
  for (const Eigen::Vector3d& x : mesh.points)
    largest = std::max(largest, ((x - body.translate) / body.scale).lpNorm<Eigen::Infinity>());
  return {body.path + "/mesh", largest};
}

}  // namespace

std::string key_beyond_numbers(const SceneFile& scene, const Mesh& mesh) {
  std::vector<Magnitude> all{{"/material/viscosity", scene.material.viscosity},
                             {"/gravity", scene.gravity.lpNorm<Eigen::Infinity>()},
                             {"/step", scene.step}};
  for (const auto& [material, path, names_model] : scene.tissues())
    all.insert(all.end(), {{path + "/density", material.density},
                           material.young > 0.0 ? Magnitude{path + "/young", material.young}
                                                : Magnitude{path + "/stiffness", material.stiffness},
                           {path + "/damping", material.damping}});
  for (const BodySource& body : scene.bodies())
    all.insert(all.end(), {{body.path + "/scale", body.scale},
                           {body.path + "/translate", body.translate.lpNorm<Eigen::Infinity>()},
                           size_of(body, mesh)});
  for (const SceneForce& force : scene.forces)
    if (force.pressure)
      all.push_back({force.path + "/pressure", std::abs(*force.pressure)});
    else
      for (const auto& [key, value] : {std::pair("/force", force.force),
                                       {"/traction", force.traction},
                                       {"/acceleration", force.acceleration},
                                       {"/torque", force.torque}})
        if (value) all.push_back({force.path + key, value->lpNorm<Eigen::Infinity>()});
  for (const ForceKind& kind : force_kinds())
    if (kind.for_each_number != nullptr)
      kind.for_each_number(scene, [&all](const std::string& path, double size) { all.push_back({path, size}); });
  for (const SceneObstacle& one : scene.obstacles)
    all.insert(all.end(), {{one.path + "/pressure", one.law.pressure}, {one.path + "/depth", one.law.depth}});
  for (const SceneTouch& touch : scene.touches) {
    const std::string path = touch.path == "/contact/bodies" ? "/contact" : touch.path;
    all.insert(all.end(), {{path + "/pressure", touch.law.pressure}, {path + "/depth", touch.law.depth}});
  }
  Magnitude worst{scene.body.path, 1.0};
  for (const Magnitude& m : all)
    if (m.decades() > worst.decades()) worst = m;
  return fmt::format("{}: is {}{:.6g}, and energies or forces at the start are not finite; expected a {} value",
                     worst.path, worst.path.ends_with("/mesh") ? "of size " : "", worst.value,
                     worst.value > 1.0 ? "smaller" : "larger");
}

std::string size_beyond_numbers(const SceneFile& scene, const Mesh& mesh) {
  for (const BodySource& body : scene.bodies())
    if (const Magnitude size = size_of(body, mesh); size.decades() >= 100)
      return fmt::format("{}: is {:.6g}", size.path, size.value);
  return "";
}

}  // namespace dartboard
