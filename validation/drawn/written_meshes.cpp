#include "validation/drawn/written_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/scene/file/scene_problem.h"
#include "core/scene/output/write_vtu.h"
#include "validation/scenes/draw.h"

namespace dartboard {
namespace {

Mesh mirrored(Mesh mesh) {
  for (Eigen::Vector3d& x : mesh.points) x.x() = -x.x();
  // solids are turned outside out where they are read, and a surface has the side that its order gives it
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (dimension(mesh.kinds[c]) == 2)
      std::reverse(mesh.nodes.begin() + mesh.first[c], mesh.nodes.begin() + mesh.first[c + 1]);
  return mesh;
}

std::vector<std::size_t> shuffled(std::size_t count, Draw& draw) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
  return order;
}

/// Points and cells of a mesh in another order, and the corners of its simplices from another one on.
struct ShuffledMesh {
  Mesh mesh;
  std::vector<std::size_t> old_point;
};
ShuffledMesh in_other_order(const Mesh& mesh, Draw& draw) {
  ShuffledMesh other{{}, shuffled(mesh.points.size(), draw)};
  std::vector<std::uint32_t> place(mesh.points.size());
  for (std::size_t k = 0; k < other.old_point.size(); ++k) {
    place[other.old_point[k]] = static_cast<std::uint32_t>(k);
    other.mesh.points.push_back(mesh.points[other.old_point[k]]);
  }
  for (const std::size_t c : shuffled(mesh.cell_count(), draw)) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t node : mesh.cell(c)) corners.push_back(place[node]);
    if (mesh.kinds[c] == CellKind::triangle || mesh.kinds[c] == CellKind::tetrahedron)
      std::rotate(corners.begin(), corners.begin() + 1, corners.begin() + 3);
    other.mesh.add_cell(mesh.kinds[c], corners);
  }
  return other;
}

void write_mesh(const std::filesystem::path& path, Mesh mesh) {
  Frame frame;
  frame.velocity.assign(mesh.points.size(), Eigen::Vector3d(0, 0, 0));
  frame.mass.assign(mesh.points.size(), 0.0);
  frame.mesh_cell.assign(mesh.cell_count(), 0);
  frame.component.assign(mesh.cell_count(), 0);
  frame.mesh = std::move(mesh);
  write_vtu(path, frame);
}

}  // namespace

WrittenScene with_written_meshes(nlohmann::ordered_json scene, const SceneFile& file,
                                 const std::filesystem::path& folder, MeshChange change) {
  WrittenScene written{std::move(scene), {}};
  Draw draw(1, 0);
  std::size_t body = 0;
  for (const BodySource& source : file.bodies()) {
    auto& object = written.json.contains("bodies") ? written.json["bodies"][body] : written.json["body"];
    Mesh mesh = make_mesh(file.file, source);
    const std::size_t first = written.number.size();
    written.number.resize(first + mesh.points.size());
    std::iota(written.number.begin() + static_cast<std::ptrdiff_t>(first), written.number.end(), first);
    if (change == MeshChange::mirrored) mesh = mirrored(std::move(mesh));
    if (change == MeshChange::renumbered) {
      ShuffledMesh other = in_other_order(mesh, draw);
      mesh = std::move(other.mesh);
      for (std::size_t k = 0; k < other.old_point.size(); ++k) written.number[first + k] = first + other.old_point[k];
    }
    const std::filesystem::path path = folder / fmt::format("body-{}.vtu", body++);
    write_mesh(path, std::move(mesh));
    for (const char* key : {"generate", "weld", "scale", "rotate", "translate"}) object.erase(key);
    object["mesh"] = std::filesystem::absolute(path).string();
  }
  return written;
}

}  // namespace dartboard
