#include "reference/cgal/cgal_body.h"

#include <gtest/gtest.h>

#include <array>

#include "core/plain/error.h"
#include "reference/adjacency_graph.h"
#include "reference/summation_bound.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::cgal_body_test {
namespace {

Problem of(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  return problem;
}

// Darts, vertices, edges, faces, volumes, components.
void expect_counts(const Mesh& mesh, const CgalCounts& expected) {
  const CgalBody body(of(mesh));
  const CgalCounts n = body.counts();
  EXPECT_TRUE(body.is_valid());
  EXPECT_EQ(n, expected) << n.darts << " " << n.vertices << " " << n.edges << " " << n.faces << " " << n.volumes << " "
                         << n.components;
}

TEST(CgalBody, OfOneTetrahedronHasTwentyFourDarts) { expect_counts(regular_tetrahedron(), {24, 4, 6, 4, 1, 1}); }

TEST(CgalBody, OfTwoTetrahedraSharesOneFace) { expect_counts(unequal_tetrahedra(), {48, 5, 9, 7, 2, 1}); }

TEST(CgalBody, OfACubeOfSixTetrahedraHasTheCellsOfAKuhnCube) {
  expect_counts(kuhn_grid(1, 1, 1, 1.0), {144, 8, 19, 18, 6, 1});
}

TEST(CgalBody, OfMixedVolumesIsAMap) {
  // a cube with a pyramid on its top and a prism at its side x = 1; a dart per corner, edge and face: 48 + 32 + 36
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},    {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 1, 0}, {0.5, 0.5, 2}};
  mesh.add_cell(CellKind::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_cell(CellKind::pyramid, std::array<std::uint32_t, 5>{4, 5, 6, 7, 10});
  mesh.add_cell(CellKind::prism, std::array<std::uint32_t, 6>{1, 8, 5, 2, 9, 6});
  // edges 12 + 8 - 4 + 9 - 4, faces 6 + 5 - 1 + 5 - 1
  expect_counts(mesh, {116, 11, 21, 14, 3, 1});
}

TEST(CgalBody, OfPolygonsIsASurface) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}};
  mesh.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{1, 4, 2});
  expect_counts(mesh, {14, 5, 6, 2, 1, 1});
}

TEST(CgalBody, OfTwoPiecesHasTwoComponents) {
  Mesh mesh = regular_tetrahedron();
  const Mesh other = regular_tetrahedron();
  for (const auto& p : other.points) mesh.points.emplace_back(p + Eigen::Vector3d(10, 0, 0));
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  expect_counts(mesh, {48, 8, 12, 8, 2, 2});
}

TEST(CgalBody, IsBuiltFromTheMeshAndNotFromItsShape) {
  Mesh mesh = regular_tetrahedron();  // and a second one in the very same place, sharing no point
  const Mesh twin = regular_tetrahedron();
  mesh.points.insert(mesh.points.end(), twin.points.begin(), twin.points.end());
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  expect_counts(mesh, {48, 8, 12, 8, 2, 2});
}

TEST(CgalBody, MovesAsTheAdjacencyGraphDoesInBothWalks) {
  Problem problem = of(kuhn_grid(3, 2, 2, 0.1, 0.1, 11));
  problem.material.damping = 0.05;
  problem.fixed = {0, 4, 8};
  problem.initial_velocity = kuhn_grid(3, 2, 2, 0.1, 1.0, 12).points;
  problem.h = 5e-4;
  AdjacencyGraph graph(problem);
  graph.step(50);  // off equilibrium
  const PointState start = graph.state();
  const auto forces = graph.spring_and_drag_forces();
  graph.step(10);
  const PointState end = graph.state();

  // derived bounds for two implementations that round differently
  const auto force_limit = force_bound(problem, start);
  const StateBound limit = state_bound(problem, start, 10);
  for (CgalWalk walk : {CgalWalk::coverage, CgalWalk::attributes}) {
    CgalBody body(problem, walk);
    body.set_state(start);
    const auto f = body.spring_and_drag_forces();
    body.step(10);
    const PointState s = body.state();
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_LE((f[i] - forces[i]).norm(), force_limit[i]);
      EXPECT_LE((s.x[i] - end.x[i]).lpNorm<Eigen::Infinity>(), limit.position);
      EXPECT_LE((s.v[i] - end.v[i]).lpNorm<Eigen::Infinity>(), limit.velocity);
    }
    EXPECT_TRUE(body.is_valid());
  }
}

TEST(CgalBody, StartsFromTheProblem) {
  Problem problem = of(unequal_tetrahedra());
  problem.fixed = {1};
  problem.initial_velocity.assign(5, {1, 2, 3});
  const PointState cgal = CgalBody(problem).state(), graph = AdjacencyGraph(problem).state();
  EXPECT_EQ(cgal.x, graph.x);
  EXPECT_EQ(cgal.v, graph.v);
}

TEST(CgalBody, RefusesThreeTetrahedraAtOneFace) {
  Mesh mesh = unequal_tetrahedra();
  mesh.points.emplace_back(1, 1, 1);
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 5});
  EXPECT_THROW(CgalBody{of(mesh)}, InputError);
}

TEST(CgalBody, RefusesTwoTetrahedraThatTouchInOnePoint) {
  Mesh mesh = regular_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}});
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 4, 5, 6});
  EXPECT_THROW(CgalBody{of(mesh)}, InputError);
}

TEST(CgalBody, RefusesAStateOfAnotherBody) {
  CgalBody body(of(regular_tetrahedron()));
  EXPECT_THROW(body.set_state({}), InputError);
}

TEST(CgalVersion, IsNamed) { EXPECT_NE(cgal_version().find('.'), std::string::npos); }

}  // namespace
}  // namespace dartboard::reference::cgal_body_test
