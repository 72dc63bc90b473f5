#include "validation/scenes/scene_of_file.h"

#include <fmt/format.h>

#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"

namespace dartboard {
namespace {

constexpr std::size_t checkpoints = 8;

}  // namespace

TradeoffScene scene_of_file(const SceneFile& file) {
  const auto fail = [&](std::string_view path, std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}: {}: {}; expected {}", file.file, path, found, expected));
  };
  if (!(file.duration > 0.0)) fail("/duration", "is 0 s", "a motion to study");
  if (file.sleep)
    fail("/sleep", "changes the motion on purpose, which is no error of an integrator", "a scene without it");
  if (file.material.stiffness == 0.0 && file.material.damping > 0.0)
    fail("/material/stiffness", "is 0 N/m together with a damping", "springs, or nothing between the vertices");
  const Problem problem = make_problem(file);
  if (problem.mesh.points.empty()) fail("/body", "has no points", "a body that moves");

  try {
    TradeoffScene made = tradeoff_scene(freeze(file, problem), checkpoints);
    // the stem of the file's name, as files are named after the scene
    made.name = std::filesystem::path(file.file).stem().string();
    return made;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.file, error.what()));
  } catch (const SolverError& error) {
    throw SolverError(fmt::format("{}: {}", file.file, error.what()));
  }
}

TradeoffScene find_scene(std::string_view name_or_file, const std::filesystem::path& meshes) {
  if (name_or_file.ends_with(".json")) return scene_of_file(read_scene(std::filesystem::path(name_or_file)));
  return make_tradeoff_scene(name_or_file, meshes);
}

}  // namespace dartboard
