#include "core/plain/mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "core/plain/error.h"

namespace dartboard {
namespace {

struct KindInfo {
  std::string_view name;
  int nodes;
  int dimension;
  std::vector<std::vector<int>> faces;
};

const KindInfo& info(CellKind kind) {
  static const std::array<KindInfo, 6> table{{
      {"triangle", 3, 2, {{0, 1, 2}}},
      {"quadrilateral", 4, 2, {{0, 1, 2, 3}}},
      {"tetrahedron", 4, 3, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}},
      {"pyramid", 5, 3, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {"prism", 6, 3, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {"hexahedron", 8, 3, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
  }};
  return table[static_cast<std::size_t>(kind)];
}

double tetrahedron_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                          const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

}  // namespace

int node_count(CellKind kind) { return info(kind).nodes; }
int dimension(CellKind kind) { return info(kind).dimension; }
std::string_view name(CellKind kind) { return info(kind).name; }
std::span<const std::vector<int>> faces_of(CellKind kind) { return info(kind).faces; }

void Mesh::add_cell(CellKind kind, std::span<const std::uint32_t> cell_nodes) {
  if (static_cast<int>(cell_nodes.size()) != node_count(kind))
    throw InputError(fmt::format("a {} has {} nodes, not {}", name(kind), node_count(kind), cell_nodes.size()));
  kinds.push_back(kind);
  nodes.insert(nodes.end(), cell_nodes.begin(), cell_nodes.end());
  first.push_back(static_cast<std::uint32_t>(nodes.size()));
}

int Mesh::dimension() const {
  int found = 0;
  for (CellKind kind : kinds) {
    const int d = dartboard::dimension(kind);
    if (found != 0 && d != found) throw InputError("a mesh holds either polygons or volumes, not both");
    found = d;
  }
  return found;
}

int Mesh::highest_dimension() const {
  int highest = 0;
  for (const CellKind kind : kinds) highest = std::max(highest, dartboard::dimension(kind));
  return highest;
}

bool is_mixed(const Mesh& mesh) {
  const auto is_solid = [](CellKind kind) { return dimension(kind) == 3; };
  const bool solids = std::ranges::any_of(mesh.kinds, is_solid), surfaces = !std::ranges::all_of(mesh.kinds, is_solid);
  return solids + surfaces + !mesh.links.empty() > 1;
}

void append(Mesh& mesh, const Mesh& other) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (mesh.points.size() + other.points.size() >= most || mesh.nodes.size() + other.nodes.size() >= most)
    throw InputError(fmt::format("{} points, or {} corners of cells, expected less than {}",
                                 mesh.points.size() + other.points.size(), mesh.nodes.size() + other.nodes.size(),
                                 most));
  const auto points = static_cast<std::uint32_t>(mesh.points.size()), nodes = mesh.first.back();
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  mesh.kinds.insert(mesh.kinds.end(), other.kinds.begin(), other.kinds.end());
  for (std::size_t c = 0; c < other.cell_count(); ++c) mesh.first.push_back(nodes + other.first[c + 1]);
  for (const std::uint32_t p : other.nodes) mesh.nodes.push_back(points + p);
  for (const auto& [a, b] : other.links) mesh.links.push_back({points + a, points + b});
}

double signed_measure(const Mesh& mesh, std::size_t c) {
  const auto cell = mesh.cell(c);
  const CellKind kind = mesh.kinds[c];
  const auto p = [&](int local) -> const Eigen::Vector3d& {
    return mesh.points[cell[static_cast<std::size_t>(local)]];
  };
  if (kind == CellKind::tetrahedron) return tetrahedron_volume(p(0), p(1), p(2), p(3));
  if (dimension(kind) == 2) {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    for (int k = 2; k < node_count(kind); ++k) twice += (p(k - 1) - p(0)).cross(p(k) - p(0));
    return twice.norm() / 2.0;
  }
  // The cone over each triangle (edge, centroid of the face), seen from the centroid of the cell. Both centroids are
  // taken relative to the first node, or their rounding would grow with the distance of the cell from the origin.
  const auto q = [&](int local) -> Eigen::Vector3d { return p(local) - p(0); };
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int k = 0; k < node_count(kind); ++k) centre += q(k) / node_count(kind);
  double volume = 0.0;
  for (const auto& face : faces_of(kind)) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int k : face) middle += q(k) / static_cast<double>(face.size());
    for (std::size_t k = 0; k < face.size(); ++k)
      volume += tetrahedron_volume(middle, q(face[k]), q(face[(k + 1) % face.size()]), centre) * -1.0;
  }
  return volume;
}

}  // namespace dartboard
