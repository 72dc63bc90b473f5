#include "reference/rebuild.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "core/plain/error.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::rebuild_test {
namespace {

constexpr double u = 0x1p-53;

const Spring* find(const Rebuilt& body, std::uint32_t a, std::uint32_t b) {
  const auto at =
      std::find_if(body.springs.begin(), body.springs.end(), [&](const Spring& s) { return s.a == a && s.b == b; });
  return at == body.springs.end() ? nullptr : &*at;
}

// A unit cell of every kind, in the corners of the unit cube.
Mesh one_cell(CellKind kind) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  if (kind == CellKind::tetrahedron) mesh.points[3] = {0, 0, 1};
  if (kind == CellKind::prism) std::rotate(mesh.points.begin() + 3, mesh.points.begin() + 4, mesh.points.end());
  std::vector<std::uint32_t> nodes(static_cast<std::size_t>(node_count(kind)));
  std::iota(nodes.begin(), nodes.end(), 0u);
  mesh.points.resize(nodes.size());
  mesh.add_cell(kind, nodes);
  return mesh;
}

TEST(Rebuild, GivesEveryPointOfATetrahedronAQuarterOfItsMass) {
  const Rebuilt body = rebuild(regular_tetrahedron(), {.density = 3.0});
  // the volume is the exact integer 16, divided by 6: one rounding there, one for the density, none for the quarter
  for (double m : body.mass) EXPECT_NEAR(m, 3.0 * 8.0 / 3.0 / 4.0, 4 * u * 2.0);
  EXPECT_EQ(body.springs.size(), 6u);
  for (const Spring& s : body.springs) EXPECT_DOUBLE_EQ(s.rest_length * s.rest_length, 8.0);
}

TEST(Rebuild, AddsTheStiffnessOfTheCellsAroundASharedEdge) {
  const Rebuilt body = rebuild(unequal_tetrahedra(), {.stiffness = 50.0, .damping = 0.25});
  ASSERT_EQ(body.springs.size(), 9u);
  for (const Spring& s : body.springs) {
    const double around = s.b < 3 ? 2.0 : 1.0;  // edges of the triangle 0 1 2 have two cells
    EXPECT_EQ(s.stiffness, 50.0 * around);
    EXPECT_EQ(s.damping, 0.25 * around);
  }
  EXPECT_EQ(find(body, 3, 4), nullptr);
  EXPECT_EQ(find(body, 0, 4)->rest_length, 2.0);
}

TEST(Rebuild, AddsTheSharesOfTheCellsAroundAPoint) {
  const Rebuilt body = rebuild(unequal_tetrahedra(), {.density = 24.0});
  // masses 4 and 8 of the cells; one rounding per volume, density, and sum
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(body.mass[i], 3.0, 4 * u * 3.0);
  EXPECT_NEAR(body.mass[3], 1.0, 4 * u);
  EXPECT_NEAR(body.mass[4], 2.0, 4 * u * 2.0);
}

TEST(Rebuild, FindsTheNineteenEdgesOfSixTetrahedraInACube) {
  const Rebuilt body = rebuild(kuhn_grid(1, 1, 1, 1.0), {.density = 1.0, .stiffness = 1.0});
  double stiffness = 0.0;
  for (const Spring& s : body.springs) stiffness += s.stiffness;
  EXPECT_EQ(body.springs.size(), 19u);
  EXPECT_EQ(stiffness, 36.0);                   // six edges of each of six tetrahedra
  EXPECT_EQ(find(body, 0, 7)->stiffness, 6.0);  // the diagonal belongs to all
}

TEST(Rebuild, KeepsTheMassOfTheWholeBody) {
  const Mesh mesh = kuhn_grid(4, 3, 2, 0.1, 0.1, 7);
  const Rebuilt body = rebuild(mesh, {.density = 1000.0});
  double cells = 0.0;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) cells += 1000.0 * signed_measure(mesh, c);
  // positive terms: sums of 144 cells and of 60 points of at most 24 shares, 2 roundings per share
  EXPECT_NEAR(std::accumulate(body.mass.begin(), body.mass.end(), 0.0), cells, (144 + 60 + 24 + 4) * u * cells);
}

TEST(Rebuild, CountsEachEdgeOfEveryKindOnce) {
  const std::array<std::pair<CellKind, std::size_t>, 6> expected{{{CellKind::triangle, 3},
                                                                  {CellKind::quadrilateral, 4},
                                                                  {CellKind::tetrahedron, 6},
                                                                  {CellKind::pyramid, 8},
                                                                  {CellKind::prism, 9},
                                                                  {CellKind::hexahedron, 12}}};
  for (const auto& [kind, edges] : expected) EXPECT_EQ(rebuild(one_cell(kind), {}).springs.size(), edges) << name(kind);
}

TEST(Rebuild, DoesNotDependOnTheHandOfATetrahedron) {
  Mesh mesh = regular_tetrahedron();
  const Rebuilt right = rebuild(mesh, {});
  std::swap(mesh.nodes[0], mesh.nodes[1]);
  EXPECT_EQ(rebuild(mesh, {}).mass, right.mass);
}

TEST(Rebuild, LeavesAPointOfNoCellWithoutMass) {
  Mesh mesh = regular_tetrahedron();
  mesh.points.emplace_back(5, 5, 5);
  EXPECT_EQ(rebuild(mesh, {}).mass[4], 0.0);
}

TEST(Rebuild, RefusesCellsThatNameNoPointOrOneTwice) {
  Mesh mesh = regular_tetrahedron();
  mesh.nodes[2] = 4;
  EXPECT_THROW(rebuild(mesh, {}), InputError);
  mesh.nodes[2] = 0;
  EXPECT_THROW(rebuild(mesh, {}), InputError);
}

}  // namespace
}  // namespace dartboard::reference::rebuild_test
