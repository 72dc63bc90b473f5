#include "validation/scenes/scene_of_file.h"

#include <fmt/format.h>

#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "validation/frozen/frozen_motion.h"

namespace dartboard {
namespace {

constexpr std::size_t checkpoints = 8;

}  // namespace

TradeoffScene scene_of_file(const SceneFile& file) {
  const auto fail = [&](std::string_view path, std::string_view found, std::string_view expected) {
    throw InputError(fmt::format("{}: {}: {}; expected {}", file.file, path, found, expected));
  };
  if (!(file.duration > 0.0)) fail("/duration", "is 0 s", "a motion to study");
  if (file.material.stiffness == 0.0 && file.material.damping > 0.0)
    fail("/material/stiffness", "is 0 N/m together with a damping", "springs, or nothing between the vertices");
  const Problem problem = make_problem(file);
  if (problem.mesh.points.empty()) fail("/body", "has no points", "a body that moves");

  TradeoffScene made{.name = {}, .what = {}, .motion = {}};
  try {
    const auto frozen = std::make_shared<FrozenScene>(freeze(file, problem));
    FrozenMotion motion = motion_of(*frozen, checkpoints);
    made.motion = std::move(motion.motion);
    made.fastest_rate = motion.fastest_rate;
    made.omissions = frozen->omissions;
    made.frozen = frozen;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.file, error.what()));
  } catch (const SolverError& error) {
    throw SolverError(fmt::format("{}: {}", file.file, error.what()));
  }
  made.beyond_references = beyond_references(file, problem.mesh);
  made.duration = file.duration;
  made.edge = reference::mean_rest_length(made.motion.network);
  if (!(made.fastest_rate > 0.0)) made.fastest_rate = 1.0 / file.duration;  // free flight only
  // the stem of the file's name, as files are named after the scene
  made.name = std::filesystem::path(file.file).stem().string();
  made.what = file.about.empty() ? file.name : file.about;
  return made;
}

TradeoffScene find_scene(std::string_view name_or_file, const std::filesystem::path& meshes) {
  if (name_or_file.ends_with(".json")) return scene_of_file(read_scene(std::filesystem::path(name_or_file)));
  return make_tradeoff_scene(name_or_file, meshes);
}

}  // namespace dartboard
