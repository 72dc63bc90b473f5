#include "core/scene/file/beyond_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

struct Magnitude {
  std::string path;
  double value;

  double decades() const { return value == 0.0 ? 0.0 : std::abs(std::log10(value)); }
};

Magnitude size_of(const BodySource& body, const Mesh& mesh) {
  if (const auto* box = std::get_if<BoxMesh>(&body.mesh)) return {"/body/generate/box/spacing", box->spacing};
  if (const auto* sheet = std::get_if<SheetMesh>(&body.mesh)) return {"/body/generate/sheet/spacing", sheet->spacing};
  if (const auto* ball = std::get_if<BallMesh>(&body.mesh)) return {"/body/generate/ball/radius", ball->radius};
  if (const auto* chain = std::get_if<ChainMesh>(&body.mesh)) return {"/body/generate/chain/spacing", chain->spacing};
  double largest = 0.0;  // of the file: before it was scaled and moved
  for (const Eigen::Vector3d& x : mesh.points)
    largest = std::max(largest, ((x - body.translate) / body.scale).lpNorm<Eigen::Infinity>());
  return {"/body/mesh", largest};
}

}  // namespace

std::string key_beyond_numbers(const SceneFile& scene, const Mesh& mesh) {
  const Material& material = scene.material;
  Magnitude worst{"/body", 1.0};
  for (const Magnitude& m : {Magnitude{"/material/density", material.density},
                             material.young > 0.0 ? Magnitude{"/material/young", material.young}
                                                  : Magnitude{"/material/stiffness", material.stiffness},
                             {"/material/damping", material.damping},
                             {"/material/viscosity", material.viscosity},
                             {"/gravity", scene.gravity.lpNorm<Eigen::Infinity>()},
                             {"/step", scene.step},
                             {"/body/scale", scene.body.scale},
                             {"/body/translate", scene.body.translate.lpNorm<Eigen::Infinity>()},
                             size_of(scene.body, mesh)})
    if (m.decades() > worst.decades()) worst = m;
  return fmt::format("{}: is {}{:.6g}, and energies or forces at the start are not finite; expected a {} value",
                     worst.path, worst.path == "/body/mesh" ? "of size " : "", worst.value,
                     worst.value > 1.0 ? "smaller" : "larger");
}

std::string size_beyond_numbers(const SceneFile& scene, const Mesh& mesh) {
  const Magnitude size = size_of(scene.body, mesh);
  return size.decades() < 100 ? "" : fmt::format("{}: is {:.6g}", size.path, size.value);
}

}  // namespace dartboard
