#include "core/scene/restart/checkpoint.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/restart/sealed_bytes.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

std::string contents_of(const fs::path& file, std::string_view expected) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    throw IoError(fmt::format("{}: there is no such file; expected {}", file.string(), expected));
  std::ifstream in(file, std::ios::binary);
  std::string bytes;
  if (fs::is_regular_file(status)) {
    bytes.resize(fs::file_size(file, error));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  if (!fs::is_regular_file(status) || error || !in)
    throw IoError(fmt::format("{}: cannot be read; expected {}", file.string(), expected));
  return bytes;
}

/// "a.mesh", "a.mesh or b.mesh"
std::string names_of_meshes(const SceneFile& scene) {
  std::string names;
  for (const BodySource& body : scene.bodies())
    if (const auto* file = std::get_if<fs::path>(&body.mesh)) names += (names.empty() ? "" : " or ") + file->string();
  return names;
}

}  // namespace

// The hash of the mesh as it was read for the run; the file may have changed since.
std::uint64_t Checkpoint::hash_of_mesh(const SceneFile& scene) {
  Hash hash;
  bool any = false;
  for (const BodySource& body : scene.bodies()) {
    if (!std::holds_alternative<fs::path>(body.mesh)) continue;
    any = true;
    const LoadedMesh read = body.loaded ? LoadedMesh{} : read_body_mesh(body);
    const Mesh& mesh = body.loaded ? body.loaded->mesh : read.mesh;
    hash.add(mesh.points);
    hash.add(mesh.kinds);
    hash.add(mesh.nodes);
  }
  return any ? hash.value() : 0;
}

void Checkpoint::write(const fs::path& file, const SceneFile& scene, const Simulation& simulation,
                       const RunProgress& progress, const OutputSoFar& output, const std::string& notes) {
  std::error_code error;
  Origin origin{.file = scene.file,
                .folder = fs::absolute(scene.folder.empty() ? "." : scene.folder, error).string(),
                .text = scene.text,
                .integrator = scene.integrator,
                .step = scene.step,
                .added_seed = scene.added_seed,
                .mesh_hash = hash_of_mesh(scene)};
  RunProgress run = progress;
  OutputSoFar written = output;
  std::string in_it = notes;
  std::uint64_t steps = simulation.steps_done();
  Archive archive;
  archive.part("scene");
  archive(origin, in_it, steps);
  archive.part("run");
  archive(run, written);
  simulation.save(archive);
  write_whole(file, sealed(archive.written()));
}

Checkpoint::Checkpoint(const fs::path& file)
    : file_(file),
      bytes_(std::make_unique<std::string>(contents_of(file, "the checkpoint of a run"))),
      archive_(unsealed(*bytes_, file.string()), file.string()) {
  archive_.part("scene");
  archive_(origin_, notes_, steps_done_);
  archive_.part("run");
  archive_(progress_, output_);
}

// The step of a scene that asks for an accuracy was chosen for its duration.
Checkpoint::Difference Checkpoint::difference_of(const std::string& text) const {
  const auto now = nlohmann::json::parse(text, nullptr, false);
  auto then = nlohmann::json::parse(origin_.text, nullptr, false);
  if (!now.is_object()) return Difference::other;
  if (now == then) return Difference::none;
  if (!now.contains("duration") || !now["duration"].is_number() || then.contains("accuracy") ||
      !(now["duration"] > then["duration"]))
    return Difference::other;
  then["duration"] = now["duration"];
  return now == then ? Difference::longer_duration : Difference::other;
}

SceneFile Checkpoint::scene() const {
  const fs::path folder = origin_.folder;
  // the path given may have been relative to a folder other than the present one
  const fs::path path = folder / fs::path(origin_.file).filename();
  std::error_code error;
  const std::string now = fs::is_regular_file(path, error) ? contents_of(path, "a scene") : origin_.text;
  const Difference difference = difference_of(now);
  if (difference == Difference::other)
    throw InputError(
        fmt::format("{}: has changed since the run in {} began; expected it as it was, or with a longer "
                    "'duration' and nothing else changed: restore it, or start a new run with --out",
                    path.string(), file_.parent_path().string()));
  SceneFile scene = parse_scene(difference == Difference::longer_duration ? now : origin_.text, path.string(), folder);
  load_mesh(scene);
  reseed(scene, origin_.added_seed);
  scene.step = origin_.step;
  scene.integrator = origin_.integrator;
  if (hash_of_mesh(scene) != origin_.mesh_hash)
    throw InputError(fmt::format("{}: is another mesh than when the run in {} began; expected it as it was",
                                 names_of_meshes(scene), file_.parent_path().string()));
  return scene;
}

void Checkpoint::load_into(Simulation& simulation) {
  simulation.load(archive_);
  archive_.require_end();
}

}  // namespace dartboard
