// Size, edges, worst cells and boundary of meshes whose facts are known.

#include "core/meshes/mesh_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/meshes/random_cells.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::mesh_facts_test {
namespace {

Mesh one(CellKind kind, std::initializer_list<Eigen::Vector3d> points) {
  Mesh mesh;
  mesh.points = points;
  std::vector<std::uint32_t> nodes(points.size());
  std::iota(nodes.begin(), nodes.end(), 0u);
  mesh.add_cell(kind, nodes);
  return mesh;
}

/// The cells of a box of cubes that `keep` keeps, by the place of their lowest corner.
template <class Keep>
Mesh cubes(int nx, int ny, int nz, Keep&& keep) {
  const Mesh box = hexahedron_box(nx, ny, nz, 1.0);
  Mesh mesh;
  mesh.points = box.points;
  for (std::size_t c = 0; c < box.cell_count(); ++c) {
    Eigen::Vector3d low = box.points[box.cell(c)[0]];
    for (const std::uint32_t p : box.cell(c)) low = low.cwiseMin(box.points[p]);
    if (keep(low)) mesh.add_cell(CellKind::hexahedron, box.cell(c));
  }
  return mesh;
}

// Of angles, a few roundings of numbers about 1, in degrees.
constexpr double close = 1e-12;

TEST(MeshFacts, OfARegularTetrahedronAreThoseOfTheBooks) {
  const MeshFacts f = facts_of(one(CellKind::tetrahedron, {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}));
  EXPECT_NEAR(f.least_edge, std::sqrt(2.0), close);
  EXPECT_NEAR(f.largest_edge, std::sqrt(2.0), close);
  EXPECT_NEAR(f.measure, 1.0 / 3.0, close);
  EXPECT_NEAR(f.smallest_angle->value, std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi, 1e-10);
  EXPECT_NEAR(f.largest_angle->value, f.smallest_angle->value, 1e-10);
  EXPECT_NEAR(f.least_radius_ratio->value, 1.0, close);
  EXPECT_EQ(f.boundary_parts, 1u);
  EXPECT_EQ(f.genus, 0u);
}

TEST(MeshFacts, OfABoxOfCubesHaveRightAngles) {
  const MeshFacts f = facts_of(hexahedron_box(3, 2, 1, 0.5));
  EXPECT_EQ(f.low, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(f.high, Eigen::Vector3d(1.5, 1, 0.5));
  EXPECT_NEAR(f.measure, 0.75, close);
  EXPECT_EQ(f.median_edge, 0.5);
  EXPECT_NEAR(f.smallest_angle->value, 90.0, close);
  EXPECT_NEAR(f.largest_angle->value, 90.0, 1e-10);
  EXPECT_FALSE(f.least_radius_ratio);
}

// 45 degrees, the diagonal across, and (1 + 1 + sqrt 2) for the circles: r = (2 - sqrt 2) / 2, R = sqrt 2 / 2.
TEST(MeshFacts, OfHalfSquaresAreThoseOfTheRightTriangle) {
  const MeshFacts f = facts_of(triangle_sheet(2, 2, 1.0));
  EXPECT_NEAR(f.smallest_angle->value, 45.0, 1e-10);
  EXPECT_NEAR(f.largest_angle->value, 90.0, 1e-10);
  EXPECT_NEAR(f.largest_edge, std::sqrt(2.0), close);
  EXPECT_EQ(f.median_edge, 1.0);  // 4 diagonals of 16 edges
  EXPECT_NEAR(f.least_radius_ratio->value, 2.0 * (2.0 - std::sqrt(2.0)) / std::sqrt(2.0), close);
  EXPECT_EQ(f.boundary_parts, 1u);
  EXPECT_FALSE(f.genus);
}

TEST(MeshFacts, NameTheFlatCellAndTheWorst) {
  Mesh mesh = one(CellKind::tetrahedron, {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}});
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(6, 0, 0), Eigen::Vector3d(5, 1, 0), Eigen::Vector3d(5.3, 0.3, 1e-3)})
    mesh.points.push_back(p);
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  const MeshFacts f = facts_of(mesh);
  EXPECT_EQ(f.flat, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(f.smallest_angle->cell, 1u);
  EXPECT_EQ(f.least_radius_ratio->cell, 1u);
  EXPECT_LT(f.least_radius_ratio->value, 0.01);
  EXPECT_EQ(f.boundary_parts, 2u);
  EXPECT_EQ(f.genus, 0u);
}

TEST(MeshFacts, CountTheHandlesOfARingAndThePartsOfAHollow) {
  const auto middle = [](const Eigen::Vector3d& x) { return x.x() == 1 && x.y() == 1; };
  const MeshFacts ring = facts_of(cubes(3, 3, 1, [&](const Eigen::Vector3d& x) { return !middle(x); }));
  EXPECT_EQ(ring.boundary_parts, 1u);
  EXPECT_EQ(ring.genus, 1u);
  const MeshFacts hollow =
      facts_of(cubes(3, 3, 3, [&](const Eigen::Vector3d& x) { return !(middle(x) && x.z() == 1); }));
  EXPECT_EQ(hollow.boundary_parts, 2u);
  EXPECT_EQ(hollow.genus, 0u);
}

TEST(MeshFacts, OfASheetWithAHoleHaveTwoBoundaryCurves) {
  const Mesh sheet = quad_sheet(3, 3, 1.0);
  Mesh mesh;
  mesh.points = sheet.points;
  for (std::size_t c = 0; c < sheet.cell_count(); ++c)
    if (c != 4) mesh.add_cell(CellKind::quadrilateral, sheet.cell(c));
  EXPECT_EQ(facts_of(mesh).boundary_parts, 2u);
  EXPECT_NEAR(facts_of(mesh).measure, 8.0, close);
}

/// Edges in a tree, and the boundary by its facets in another.
void expect_facts_of_trees(const Mesh& mesh) {
  std::set<std::set<std::uint32_t>> edges;
  std::map<std::set<std::uint32_t>, int> facets;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      std::set<std::uint32_t> face;
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        const std::uint32_t a = mesh.cell(c)[static_cast<std::size_t>(cycle[k])],
                            b = mesh.cell(c)[static_cast<std::size_t>(cycle[(k + 1) % cycle.size()])];
        edges.insert({a, b});
        face.insert(a);
        if (dimension(mesh.kinds[c]) == 2) ++facets[{a, b}];
      }
      if (dimension(mesh.kinds[c]) == 3) ++facets[face];
    }
  std::vector<double> lengths;
  for (const auto& edge : edges) lengths.push_back((mesh.points[*edge.rbegin()] - mesh.points[*edge.begin()]).norm());
  std::ranges::sort(lengths);
  const std::size_t n = lengths.size();
  const MeshFacts found = facts_of(mesh);
  EXPECT_EQ(found.least_edge, lengths.front());
  EXPECT_EQ(found.largest_edge, lengths.back());
  EXPECT_EQ(found.median_edge, n % 2 == 1 ? lengths[n / 2] : 0.5 * (lengths[n / 2 - 1] + lengths[n / 2]));

  // parts: facets of one cell, joined where they share an edge (in a surface a point)
  const std::size_t common = mesh.dimension() == 3 ? 2 : 1;
  std::vector<std::vector<std::set<std::uint32_t>>> joined;
  for (const auto& met : facets) {
    const std::set<std::uint32_t>& facet = met.first;
    if (met.second != 1) continue;
    std::vector<std::set<std::uint32_t>> own{facet};
    std::erase_if(joined, [&](const auto& part) {
      const bool touches = std::ranges::any_of(part, [&](const auto& other) {
        return std::ranges::count_if(other, [&](std::uint32_t p) { return facet.contains(p); }) >=
               static_cast<std::ptrdiff_t>(common);
      });
      if (touches) own.insert(own.end(), part.begin(), part.end());
      return touches;
    });
    joined.push_back(std::move(own));
  }
  EXPECT_EQ(found.boundary_parts, joined.size());
}

TEST(MeshFacts, OfScatteredCellsAreThoseOfTrees) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const double share = 0.15 + 0.1 * seed;
    expect_facts_of_trees(random_cells_of(kuhn_grid(3, 2, 2, 1.0, 0.1, seed), share, seed));
    expect_facts_of_trees(random_cells_of(triangle_sheet(5, 4, 1.0), share, seed));
  }
  expect_facts_of_trees(mixed_cells());
}

}  // namespace
}  // namespace dartboard::mesh_facts_test
