#include "core/meshes/mesh_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>

#include "core/base/disjoint_sets.h"
#include "core/base/median.h"
#include "core/base/point_sets.h"

namespace dartboard {
namespace {

using Pair = std::array<std::uint32_t, 2>;

Pair ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// A few values in a row, without memory of their own.
template <class Value, std::size_t most>
struct Few {
  std::array<Value, most> values;
  std::size_t count = 0;

  void push_back(const Value& value) { values[count++] = value; }
  std::size_t size() const { return count; }
  const Value& operator[](std::size_t k) const { return values[k]; }
  const Value* begin() const { return values.data(); }
  const Value* end() const { return values.data() + count; }
};

/// The points of a face or of an edge, in cyclic order.
using Cycle = Few<std::uint32_t, 4>;
/// The faces of a cell.
using Faces = Few<Cycle, 6>;

Faces faces_of_cell(const Mesh& mesh, std::size_t c) {
  Faces faces;
  const auto node = mesh.cell(c);
  for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
    Cycle& face = faces.values[faces.count++];
    face.count = 0;
    for (const int k : cycle) face.push_back(node[static_cast<std::size_t>(k)]);
  }
  return faces;
}

/// Twice the area, outwards: exact for a plane face.
Eigen::Vector3d normal_of(const Mesh& mesh, const Cycle& face) {
  Eigen::Vector3d normal(0, 0, 0);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    normal += (mesh.points[face[k]] - mesh.points[face[0]]).cross(mesh.points[face[k + 1]] - mesh.points[face[0]]);
  return normal;
}

using Normals = Few<Eigen::Vector3d, 6>;

Normals normals_of(const Mesh& mesh, const Faces& faces) {
  Normals normals;
  for (const Cycle& face : faces) normals.push_back(normal_of(mesh, face));
  return normals;
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

using Angles = Few<double, 12>;

Angles angles_at_corners(const Mesh& mesh, const Cycle& corners) {
  Angles angles;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector3d& x = mesh.points[corners[k]];
    angles.push_back(degrees_between(mesh.points[corners[(k + 1) % n]] - x, mesh.points[corners[(k + n - 1) % n]] - x));
  }
  return angles;
}

/// The angle along each edge of a volume. Calls new_edge(edge) for each.
Angles angles_at_edges(const Faces& faces, const Normals& normals, auto&& new_edge) {
  Angles angles;
  Few<Pair, 12> edges;
  Few<std::size_t, 12> first;  // by edge: the face met there first
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      const Pair edge = ascending(faces[f][k], faces[f][(k + 1) % faces[f].size()]);
      std::size_t at = 0;
      while (at < edges.size() && (edges[at][0] != edge[0] || edges[at][1] != edge[1])) ++at;
      if (at < edges.size()) {
        angles.push_back(180.0 - degrees_between(normals[first[at]], normals[f]));
      } else {
        edges.push_back(edge);
        first.push_back(f);
        new_edge(edge);
      }
    }
  return angles;
}

std::optional<double> radius_ratio(const Mesh& mesh, std::size_t c, const Normals& normals) {
  const auto node = mesh.cell(c);
  if (mesh.kinds[c] == CellKind::triangle) {
    const double a = (mesh.points[node[1]] - mesh.points[node[0]]).norm(),
                 b = (mesh.points[node[2]] - mesh.points[node[1]]).norm(),
                 d = (mesh.points[node[0]] - mesh.points[node[2]]).norm();
    // r = 2 A / (a + b + d), R = a b d / (4 A)
    const double area = 0.5 * normals[0].norm();
    return 16.0 * area * area / ((a + b + d) * a * b * d);
  }
  if (mesh.kinds[c] != CellKind::tetrahedron) return {};
  const Eigen::Vector3d a = mesh.points[node[1]] - mesh.points[node[0]],
                        b = mesh.points[node[2]] - mesh.points[node[0]],
                        d = mesh.points[node[3]] - mesh.points[node[0]];
  double area = 0.0;
  for (const Eigen::Vector3d& normal : normals) area += 0.5 * normal.norm();
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
std::vector<Cycle> boundary_facets(const Mesh& mesh) {
  using Facets = PointSets<4>;
  constexpr std::uint32_t shared = Facets::none - 1;
  Facets met(mesh.points.size(), mesh.nodes.size());
  const auto for_each_facet = [&mesh](std::size_t c, auto&& f) {
    const bool solid = dimension(mesh.kinds[c]) == 3;
    for (const Cycle& face : faces_of_cell(mesh, c))
      for (std::size_t k = 0; k < (solid ? 1 : face.size()); ++k)
        f(solid ? face : Cycle{{face[k], face[(k + 1) % face.size()]}, 2});
  };
  const auto set_of = [](const Cycle& facet) { return Facets::set_of(std::span(facet.begin(), facet.size())); };
  std::vector<bool> has_boundary(mesh.cell_count(), false);
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
    for_each_facet(c, [&](const Cycle& facet) {
      std::uint32_t& cell = met.number_of(set_of(facet));
      cell = cell == Facets::none ? c : shared;
    });
  met.for_each([&](std::uint32_t cell) {
    if (cell != shared) has_boundary[cell] = true;
  });
  std::vector<Cycle> facets;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
    if (has_boundary[c])
      for_each_facet(c, [&](const Cycle& facet) {
        if (met.number_of(set_of(facet)) != shared) facets.push_back(facet);
      });
  return facets;
}

void add_boundary(const Mesh& mesh, MeshFacts& facts) {
  const std::vector<Cycle> facets = boundary_facets(mesh);
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
  PointSets<2> edges(mesh.points.size(), mesh.nodes.size());
  std::vector<double> lengths;
  const auto add_edge = [&](const Pair& edge) {
    if (std::uint32_t& met = edges.number_of(edge); met == PointSets<2>::none) {
      met = 0;
      lengths.push_back((mesh.points[edge[1]] - mesh.points[edge[0]]).norm());
    }
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    facts.measure += std::abs(signed_measure(mesh, c));
    const Faces faces = faces_of_cell(mesh, c);
    const Normals normals = normals_of(mesh, faces);
    const bool solid = dimension(mesh.kinds[c]) == 3;
    for (std::size_t k = 0; !solid && k < faces[0].size(); ++k)
      add_edge(ascending(faces[0][k], faces[0][(k + 1) % faces[0].size()]));
    const Angles angles = solid ? angles_at_edges(faces, normals, add_edge) : angles_at_corners(mesh, faces[0]);
    const auto [least, largest] = std::minmax_element(angles.begin(), angles.end());
    keep_less(facts.smallest_angle, *least, c);
    if (!facts.largest_angle || *largest > facts.largest_angle->value)
      facts.largest_angle = {*largest, static_cast<std::uint32_t>(c)};
    if (*least < flat_below_degrees) facts.flat.push_back(static_cast<std::uint32_t>(c));
    if (const auto ratio = radius_ratio(mesh, c, normals)) keep_less(facts.least_radius_ratio, *ratio, c);
  }
  facts.edges = lengths.size();
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
