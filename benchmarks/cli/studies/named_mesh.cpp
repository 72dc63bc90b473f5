#include "benchmarks/cli/studies/named_mesh.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/tell.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/scene/file/load_mesh.h"
#include "validation/cgal/delaunay_ball.h"

namespace dartboard {
namespace {

MeshSource file_source(const std::filesystem::path& path) {
  return {path.string(), [path] {
            LoadedMesh loaded = read_body_mesh({.mesh = path, .scale = 1.0, .translate = {0, 0, 0}});
            for (const std::string& notice : loaded.notices) tell(stderr, "notice: {}: {}\n", path.string(), notice);
            return std::move(loaded.mesh);
          }};
}

std::vector<MeshSource> generated() {
  std::vector<MeshSource> sources;
  for (const auto& meshes : {test_meshes(), delaunay_meshes()})
    for (const NamedMesh& mesh : meshes) sources.push_back({mesh.name, mesh.make});
  return sources;
}

}  // namespace

MeshSource find_mesh(const std::string& name) {
  for (const MeshSource& source : generated())
    if (source.name == name) return source;
  return file_source(name);
}

std::vector<MeshSource> all_meshes() {
  std::vector<MeshSource> sources = generated();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() / "benchmarks/meshes"))
    if (entry.path().extension() == ".mesh") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) sources.push_back(file_source(file));
  return sources;
}

}  // namespace dartboard
