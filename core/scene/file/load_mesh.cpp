#include "core/scene/file/load_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/base/overloads.h"
#include "core/meshes/touching.h"
#include "core/plain/error.h"
#include "core/scene/file/cell_tags.h"
#include "core/scene/file/force_kind.h"

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
  for (std::size_t k = 0; k < scene.fixed.size(); ++k)
    visit_ids(scene.fixed[k].vertices, fmt::format("/fixed/{}", k), visit);
  for (SceneDrive& drive : scene.driven) visit_ids(drive.vertices, drive.path, visit);
  for (SceneForce& force : scene.forces) visit_ids(force.vertices, force.path, visit);
  for_each_selection_of_forces(
      scene, [&visit](const std::string& path, VertexSelection& vertices) { visit_ids(vertices, path, visit); });
  for (Probe& probe : scene.probes)
    if (auto* point = std::get_if<std::uint32_t>(&probe.vertex)) visit(*point, probe.path + "/vertex");
  const Overloads visit_choice{
      [&visit](const std::string& path, std::uint32_t& point) { visit(point, path); },
      [&visit](const std::string& path, VertexSelection& vertices) { visit_ids(vertices, path, visit); },
      [&visit](const std::string& path, FacetPoints& facets) {
        for (std::size_t k = 0; k < facets.size(); ++k)
          for (std::size_t j = 0; j < facets[k].size(); ++j) visit(facets[k][j], fmt::format("{}/{}/{}", path, k, j));
      },
      [](const std::string&, const CellSelection&) {}};
  for (SceneEvent& event : scene.events) for_each_choice(event, visit_choice);
}

/// The points of a mesh that one point of its file became: itself, and those split off it.
class Places {
 public:
  Places(const LoadedMesh& loaded, const TouchingCells& touching) : mesh_(loaded.mesh) {
    const auto kept = static_cast<std::uint32_t>(mesh_.points.size() - touching.copied.size());
    for (std::uint32_t k = 0; k < touching.copied.size(); ++k) copies_.push_back({touching.copied[k], kept + k});
    std::ranges::sort(copies_);
  }
  bool any() const { return !copies_.empty(); }

  void add_all(std::vector<std::uint32_t>& points) const {
    const std::size_t named = points.size();
    for (std::size_t k = 0; k < named; ++k)
      for (const auto& [of, copy] : copies_)
        if (of == points[k]) points.push_back(copy);
  }

  /// Replaces these points by those of the mesh's face with the same points, or copies of them; otherwise does nothing.
  void find_face(std::vector<std::uint32_t>& points) const {
    if (std::ranges::none_of(points, [this](std::uint32_t p) { return is_copied(p); })) return;
    auto places = points;
    std::ranges::sort(places);
    for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
      const auto node = mesh_.cell(c);
      const bool solid = dimension(mesh_.kinds[c]) == 3;
      for (const std::vector<int>& cycle : faces_of(mesh_.kinds[c]))
        for (std::size_t first = 0; first < (solid ? 1 : cycle.size()); ++first) {
          std::vector<std::uint32_t> face;
          for (std::size_t k = 0; k < (solid ? cycle.size() : 2); ++k)
            face.push_back(node[static_cast<std::size_t>(cycle[(first + k) % cycle.size()])]);
          std::vector<std::uint32_t> there;
          for (const std::uint32_t p : face) there.push_back(place_of(p));
          std::ranges::sort(there);
          if (there != places) continue;
          points = face;
          return;
        }
    }
  }

 private:
  bool is_copied(std::uint32_t p) const {
    return std::ranges::any_of(copies_, [p](const auto& pair) { return pair.first == p; });
  }
  std::uint32_t place_of(std::uint32_t p) const {
    for (const auto& [of, copy] : copies_)
      if (copy == p) return of;
    return p;
  }

  const Mesh& mesh_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> copies_;  // (point, one split off it), ascending
};

void renumber(SceneFile& scene, const std::vector<std::uint32_t>& place) {
  visit_points(scene, [&](std::uint32_t& point, const std::string& path) {
    const auto fail = [&](const std::string& expected) { scene.fail(path, fmt::format("is {}", point), expected); };
    if (point >= place.size()) fail(fmt::format("a point of the mesh, less than {}", place.size()));
    if (place[point] == LoadedMesh::dropped) fail("a point that belongs to a cell: this one of the mesh does not");
    point = place[point];
  });
}

void name_all_vertices(SceneFile& scene, const Places& places) {
  const auto all_of = [&places](VertexSelection& selection) {
    if (auto* by_id = std::get_if<IdSelection>(&selection)) places.add_all(by_id->ids);
  };
  for (HeldSelection& held : scene.fixed) all_of(held.vertices);
  for (SceneDrive& drive : scene.driven) all_of(drive.vertices);
  for (SceneForce& force : scene.forces) all_of(force.vertices);
  for_each_selection_of_forces(scene, [&all_of](const std::string&, VertexSelection& vertices) { all_of(vertices); });
  const Overloads name_in_choice{[&all_of](const std::string&, VertexSelection& vertices) { all_of(vertices); },
                                 [&places](const std::string&, FacetPoints& facets) {
                                   for (auto& points : facets) places.find_face(points);
                                 },
                                 [](const std::string&, const CellSelection&) {},
                                 [](const std::string&, std::uint32_t) {}};
  for (SceneEvent& event : scene.events) for_each_choice(event, name_in_choice);
}

std::pair<LoadedMesh, TouchingCells> read_and_split(const BodySource& body) {
  const auto& file = std::get<std::filesystem::path>(body.mesh);
  LoadedMesh loaded = read_mesh_file(file, {.weld = body.weld});
  const std::size_t points = loaded.mesh.points.size();
  TouchingCells touching = split_touching_points(loaded.mesh);
  loaded.copied = touching.copied;
  if (touching.any()) {
    if (loaded.place_of_point.empty()) {
      loaded.place_of_point.resize(points);
      std::iota(loaded.place_of_point.begin(), loaded.place_of_point.end(), 0u);
    }
    const std::string notice = to_string(touching, loaded.place_of_point);
    if (!body.split_touching)
      throw InputError(fmt::format("{}: {}; expected none, or \"touching\": \"split\"", file.string(), notice));
    loaded.notices.push_back(notice);
  }
  return {std::move(loaded), std::move(touching)};
}

}  // namespace

LoadedMesh read_body_mesh(const BodySource& body) { return read_and_split(body).first; }

namespace {

/// No value for a mesh that is refused: making the body fails for the same reason, and that error names the key.
std::optional<std::pair<LoadedMesh, TouchingCells>> read_or_nothing(const BodySource& body) {
  try {
    return read_and_split(body);
  } catch (const IoError&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A number does not say which body it counts in; a place is unambiguous.
void require_no_point_numbers(SceneFile& scene) {
  visit_points(scene, [&scene](std::uint32_t& point, const std::string& path) {
    scene.fail(path, fmt::format("is {} together with /bodies", point),
               "a place, because numbers are ambiguous with several bodies");
  });
}

void load_bodies(SceneFile& scene, BodyList& bodies) {
  require_no_point_numbers(scene);
  for (BodySource& body : bodies.all) {
    if (!std::holds_alternative<std::filesystem::path>(body.mesh)) continue;
    auto read = read_or_nothing(body);
    if (!read) return;
    body.loaded = std::make_shared<LoadedMesh>(std::move(read->first));
  }
  resolve_tags(scene);
}

}  // namespace

void load_mesh(SceneFile& scene) {
  if (auto* bodies = std::get_if<BodyList>(&scene.body.mesh)) return load_bodies(scene, *bodies);
  if (!std::holds_alternative<std::filesystem::path>(scene.body.mesh)) return resolve_tags(scene);
  auto read = read_or_nothing(scene.body);
  if (!read) return;
  auto& [loaded, touching] = *read;
  if (!loaded.place_of_point.empty()) renumber(scene, loaded.place_of_point);
  if (const Places places(loaded, touching); places.any()) name_all_vertices(scene, places);
  scene.body.loaded = std::make_shared<LoadedMesh>(std::move(loaded));
  resolve_tags(scene);
}

std::size_t number_in_file(const SceneFile& scene, std::uint32_t point) {
  return scene.body.loaded ? scene.body.loaded->number_in_file(point) : point;
}

std::vector<std::uint32_t> numbers_in_file(const SceneFile& scene) {
  return scene.body.loaded ? scene.body.loaded->numbers_in_file() : std::vector<std::uint32_t>{};
}

}  // namespace dartboard
