#include "core/meshes/mesh_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/base/disjoint_sets.h"
#include "core/base/median.h"

namespace dartboard {
namespace {

using Pair = std::array<std::uint32_t, 2>;
using Points = std::vector<std::uint32_t>;

Pair ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The faces of a cell as cycles of points.
std::vector<Points> faces_of_cell(const Mesh& mesh, std::size_t c) {
  std::vector<Points> faces;
  for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
    faces.emplace_back();
    for (const int k : cycle) faces.back().push_back(mesh.cell(c)[static_cast<std::size_t>(k)]);
  }
  return faces;
}

/// Twice the area, outwards: exact for a plane face.
Eigen::Vector3d normal_of(const Mesh& mesh, const Points& face) {
  Eigen::Vector3d normal(0, 0, 0);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    normal += (mesh.points[face[k]] - mesh.points[face[0]]).cross(mesh.points[face[k + 1]] - mesh.points[face[0]]);
  return normal;
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

std::vector<double> angles_of(const Mesh& mesh, std::size_t c) {
  const auto faces = faces_of_cell(mesh, c);
  std::vector<double> angles;
  if (dimension(mesh.kinds[c]) == 2) {
    const Points& corners = faces[0];
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Eigen::Vector3d& x = mesh.points[corners[k]];
      angles.push_back(
          degrees_between(mesh.points[corners[(k + 1) % n]] - x, mesh.points[corners[(k + n - 1) % n]] - x));
    }
    return angles;
  }
  std::map<Pair, Eigen::Vector3d> first;  // by edge: the normal of the first face met there
  for (const Points& face : faces) {
    const Eigen::Vector3d normal = normal_of(mesh, face);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [at, is_new] = first.emplace(ascending(face[k], face[(k + 1) % face.size()]), normal);
      if (!is_new) angles.push_back(180.0 - degrees_between(at->second, normal));
    }
  }
  return angles;
}

std::optional<double> radius_ratio(const Mesh& mesh, std::size_t c) {
  const auto node = mesh.cell(c);
  if (mesh.kinds[c] == CellKind::triangle) {
    const double a = (mesh.points[node[1]] - mesh.points[node[0]]).norm(),
                 b = (mesh.points[node[2]] - mesh.points[node[1]]).norm(),
                 d = (mesh.points[node[0]] - mesh.points[node[2]]).norm();
    // r = 2 A / (a + b + d), R = a b d / (4 A)
    const double area = 0.5 * normal_of(mesh, {node[0], node[1], node[2]}).norm();
    return 16.0 * area * area / ((a + b + d) * a * b * d);
  }
  if (mesh.kinds[c] != CellKind::tetrahedron) return {};
  const Eigen::Vector3d a = mesh.points[node[1]] - mesh.points[node[0]],
                        b = mesh.points[node[2]] - mesh.points[node[0]],
                        d = mesh.points[node[3]] - mesh.points[node[0]];
  double area = 0.0;
  for (const Points& face : faces_of_cell(mesh, c)) area += 0.5 * normal_of(mesh, face).norm();
  const double six_volumes = std::abs(a.dot(b.cross(d)));
  // r = 3 V / A, and the centre of the sphere around is at the vector below over 12 V
  const Eigen::Vector3d centre =
      a.squaredNorm() * b.cross(d) + b.squaredNorm() * d.cross(a) + d.squaredNorm() * a.cross(b);
  const double around = centre.norm();
  return around > 0.0 ? 3.0 * (six_volumes / 2.0 / area) * 2.0 * six_volumes / around : 0.0;
}

void keep_less(std::optional<OfCell>& least, double value, std::size_t cell) {
  if (!least || !(value >= least->value)) least = {value, static_cast<std::uint32_t>(cell)};
}

/// Faces of volumes, or edges of polygons, that belong to one cell only.
std::vector<Points> boundary_facets(const Mesh& mesh) {
  std::map<Points, std::pair<Points, int>> met;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const Points& face : faces_of_cell(mesh, c)) {
      const bool solid = dimension(mesh.kinds[c]) == 3;
      for (std::size_t k = 0; k < (solid ? 1 : face.size()); ++k) {
        const Points facet = solid ? face : Points{face[k], face[(k + 1) % face.size()]};
        Points key = facet;
        std::sort(key.begin(), key.end());
        auto& entry = met[key];
        entry.first = facet;
        ++entry.second;
      }
    }
  std::vector<Points> facets;
  for (const auto& [key, entry] : met)
    if (entry.second == 1) facets.push_back(entry.first);
  return facets;
}

void add_boundary(const Mesh& mesh, MeshFacts& facts) {
  const std::vector<Points> facets = boundary_facets(mesh);
  if (facets.empty()) return;
  DisjointSets parts(facets.size());
  // facets are joined by edges, the edges of a surface by points
  const bool solid = facets[0].size() > 2;
  std::map<Pair, std::vector<std::uint32_t>> around;
  std::set<std::uint32_t> points;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    points.insert(facets[f].begin(), facets[f].end());
    for (std::size_t k = 0; k < facets[f].size(); ++k) {
      const std::uint32_t a = facets[f][k], b = solid ? facets[f][(k + 1) % facets[f].size()] : a;
      around[ascending(a, b)].push_back(f);
    }
  }
  bool is_surface = true;
  for (const auto& [edge, with] : around) {
    is_surface = is_surface && with.size() == 2;
    for (const std::uint32_t f : with) parts.join(with[0], f);
  }
  facts.boundary_parts = parts.count();
  if (!solid || !is_surface) return;
  // a point that two parts share is counted once here and twice in the formula
  std::map<std::uint32_t, std::set<std::uint32_t>> parts_at;
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (const std::uint32_t p : facets[f]) parts_at[p].insert(parts.set_of(f));
  std::size_t vertices = 0;
  for (const auto& [point, of] : parts_at) vertices += of.size();
  // V - E + F = 2 (parts - handles)
  const auto euler = static_cast<std::ptrdiff_t>(vertices + facets.size()) - static_cast<std::ptrdiff_t>(around.size());
  const std::ptrdiff_t twice = 2 * static_cast<std::ptrdiff_t>(facts.boundary_parts) - euler;
  if (twice >= 0 && twice % 2 == 0) facts.genus = static_cast<std::size_t>(twice / 2);
}

}  // namespace

MeshFacts facts_of(const Mesh& mesh) {
  MeshFacts facts;
  if (mesh.points.empty()) return facts;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : mesh.points) box.extend(x);
  facts.low = box.min();
  facts.high = box.max();
  std::set<Pair> edges;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    facts.measure += std::abs(signed_measure(mesh, c));
    for (const Points& face : faces_of_cell(mesh, c))
      for (std::size_t k = 0; k < face.size(); ++k) edges.insert(ascending(face[k], face[(k + 1) % face.size()]));
    const auto angles = angles_of(mesh, c);
    const auto [least, largest] = std::minmax_element(angles.begin(), angles.end());
    keep_less(facts.smallest_angle, *least, c);
    if (!facts.largest_angle || *largest > facts.largest_angle->value)
      facts.largest_angle = {*largest, static_cast<std::uint32_t>(c)};
    if (*least < flat_below_degrees) facts.flat.push_back(static_cast<std::uint32_t>(c));
    if (const auto ratio = radius_ratio(mesh, c)) keep_less(facts.least_radius_ratio, *ratio, c);
  }
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) lengths.push_back((mesh.points[b] - mesh.points[a]).norm());
  if (!lengths.empty()) {
    const auto [least, largest] = std::minmax_element(lengths.begin(), lengths.end());
    facts.least_edge = *least;
    facts.largest_edge = *largest;
    facts.median_edge = median_of(lengths);
  }
  add_boundary(mesh, facts);
  return facts;
}

}  // namespace dartboard
