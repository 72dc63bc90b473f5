#include "core/scene/file/point_numbers.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Visit = std::function<void(std::uint32_t&, const std::string& path)>;

void visit_ids(VertexSelection& selection, const std::string& path, const Visit& visit) {
  auto* by_id = std::get_if<IdSelection>(&selection);
  if (by_id == nullptr) return;
  for (std::size_t k = 0; k < by_id->ids.size(); ++k) visit(by_id->ids[k], fmt::format("{}/ids/{}", path, k));
}

/// Every number of a point in the scene, with the path of its key.
void visit_points(SceneFile& scene, const Visit& visit) {
  for (std::size_t k = 0; k < scene.fixed.size(); ++k) visit_ids(scene.fixed[k], fmt::format("/fixed/{}", k), visit);
  for (SceneDrive& drive : scene.driven) visit_ids(drive.vertices, drive.path, visit);
  for (Probe& probe : scene.probes)
    if (auto* point = std::get_if<std::uint32_t>(&probe.vertex)) visit(*point, probe.path + "/vertex");
  for (SceneEvent& event : scene.events) {
    if (auto* tear = std::get_if<Tear>(&event.action)) {
      if (auto* point = std::get_if<std::uint32_t>(&tear->vertex)) visit(*point, event.path + "/tear/vertex");
    } else if (auto* dissociate = std::get_if<Dissociate>(&event.action)) {
      auto* faces = std::get_if<0>(&dissociate->faces);
      for (std::size_t k = 0; faces != nullptr && k < faces->size(); ++k)
        for (std::size_t j = 0; j < (*faces)[k].size(); ++j)
          visit((*faces)[k][j], fmt::format("{}/dissociate/points/{}/{}", event.path, k, j));
    }
  }
}

}  // namespace

void number_points_as_kept(SceneFile& scene) {
  const auto* file = std::get_if<std::filesystem::path>(&scene.body.mesh);
  if (file == nullptr) return;
  bool any = false;
  visit_points(scene, [&any](std::uint32_t&, const std::string&) { any = true; });
  if (!any) return;
  std::vector<std::uint32_t> place;
  try {
    place = read_mesh(*file).place_of_point;
  } catch (const IoError&) {
    return;
  }
  if (place.empty()) return;
  visit_points(scene, [&](std::uint32_t& point, const std::string& path) {
    const auto fail = [&](const std::string& expected) {
      throw InputError(fmt::format("{}: {}: is {}; expected {}", scene.file, path, point, expected));
    };
    if (point >= place.size()) fail(fmt::format("a point of the mesh, less than {}", place.size()));
    if (place[point] == LoadedMesh::dropped) fail("a point that belongs to a cell: this one of the mesh does not");
    point = place[point];
  });
}

}  // namespace dartboard
