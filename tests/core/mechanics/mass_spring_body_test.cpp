#include "core/mechanics/mass_spring_body.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::mass_spring_body_test {
namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

Problem problem_of(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  return problem;
}

template <class C>
class Body : public testing::Test {};
template <class MapType, Held how>
struct Choice {
  using Map = MapType;
  static constexpr Held held = how;
};
using Choices = testing::Types<Choice<Map3, Held::by_one_dart>, Choice<Map3, Held::by_every_dart>,
                               Choice<TetMap, Held::by_one_dart>, Choice<TetMap, Held::by_every_dart>>;
TYPED_TEST_SUITE(Body, Choices);

// Every term is positive, so a computed sum of n of them is within (n - 1) u of the exact one, relatively, to first
// order. The vertex sums add at most N shares (each a product and a quotient: 2 u), then V masses; the cell sum adds C.
// Second-order terms are covered by the factor 1.01: (N + V + C) u is below 1e-12 here.
template <class B>
void expect_equal_masses(const B& body) {
  const double vertices = std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0);
  const double cells = std::accumulate(body.cell_mass.begin(), body.cell_mass.end(), 0.0);
  const double terms = static_cast<double>(2 * body.cell_mass.size() + body.vertices.size() + 2);
  EXPECT_NEAR(vertices, cells, 1.01 * terms * u * cells);
}

TYPED_TEST(Body, VertexMassesSumToTheMassOfTheCells) {
  const Problem problem = problem_of(kuhn_grid(3, 2, 2, 0.1, 0.1, 5));
  expect_equal_masses(build_body<typename TypeParam::Map, TypeParam::held>(problem));
}

// Volumes 1/6 and 1/3 and density 12: masses 2 and 4, a quarter of each to its nodes. eq. (1), exact in binary if the
// product 12 * fl(1/6) is: 1/6 is rounded by at most u/6, so the product is 2 after rounding.
TYPED_TEST(Body, AVertexHasAQuarterOfEachTetrahedronAroundIt) {
  Problem problem = problem_of(unequal_tetrahedra());
  problem.material.density = 12.0;
  const auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem);
  ASSERT_EQ(body.vertices.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto p = body.vertices.point[k];
    EXPECT_DOUBLE_EQ(body.vertices.mass[k], p == 3 ? 0.5 : p == 4 ? 1.0 : 1.5);
    EXPECT_EQ(body.vertices.viscosity[k], problem.material.viscosity * body.vertices.mass[k]);
    EXPECT_EQ(body.vertices.position[k], problem.mesh.points[p]);
  }
}

TYPED_TEST(Body, AnEdgeHasTheStiffnessOfTheTetrahedraAroundIt) {
  Problem problem = problem_of(kuhn_grid(2, 2, 1, 1.0));
  const auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem);
  double shares = 0;
  for_each_cell<1>(body.map, [&](Edge e) {
    const Spring& spring = body.springs[body.edge(body.map, e.dart)];
    const auto around = static_cast<double>(incident_cells<3>(body.map, e).size());
    EXPECT_EQ(spring.stiffness, around * problem.material.stiffness);
    EXPECT_EQ(spring.damping, around * problem.material.damping);
    shares += around;
  });
  EXPECT_EQ(shares, 6.0 * 24.0);  // six edges of each tetrahedron
}

TYPED_TEST(Body, EmbedsOneNumberForEachCellFoundFromAllItsDarts) {
  const Problem problem = problem_of(kuhn_grid(2, 1, 1, 1.0));
  const auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem);
  std::uint32_t vertex = 0, edge = 0;
  for_each_cell<0>(body.map, [&](Vertex v) {
    for (const Dart d : orbit(body.map, v)) ASSERT_EQ(body.vertex(body.map, d), vertex);
    ++vertex;
  });
  for_each_cell<1>(body.map, [&](Edge e) {
    for (const Dart d : orbit(body.map, e)) ASSERT_EQ(body.edge(body.map, d), edge);
    ++edge;
  });
  for (std::uint32_t c = 0; c < 12; ++c)
    for (const Dart d : orbit(body.map, Volume{{24 * c}})) ASSERT_EQ(body.cell(body.map, d), c);
  EXPECT_EQ(vertex, body.vertices.size());
  EXPECT_EQ(edge, body.springs.size());
}

TYPED_TEST(Body, KeepsAStateThatItWasGiven) {
  auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem_of(unequal_tetrahedra()));
  PointState state;
  for (int p = 0; p < 5; ++p) {
    state.x.emplace_back(p, 0.1 * p, -p);
    state.v.emplace_back(0.3, p, 1.0 / (p + 1));
  }
  body.set_state(state);
  EXPECT_EQ(body.state().x, state.x);
  EXPECT_EQ(body.state().v, state.v);
}

TYPED_TEST(Body, HoldsFixedVerticesAtRestWhateverTheStateSays) {
  Problem problem = problem_of(unequal_tetrahedra());
  problem.fixed = {1, 4};
  problem.initial_velocity.assign(5, {1, 2, 3});
  auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem);
  const auto expect_rest = [&] {
    const PointState state = body.state();
    for (std::size_t p = 0; p < 5; ++p)
      EXPECT_EQ(state.v[p], p == 1 || p == 4 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(1, 2, 3)) << p;
  };
  expect_rest();
  body.set_state({problem.mesh.points, problem.initial_velocity});
  expect_rest();
}

// A body mirrored in two axes, or rotated by half a turn, changes signs in pairs.
TYPED_TEST(Body, HashesStatesApartThatDifferInSignsOnly) {
  auto body = build_body<typename TypeParam::Map, TypeParam::held>(problem_of(unequal_tetrahedra()));
  PointState state = body.state();
  state.v.assign(5, {1, 2, 3});
  body.set_state(state);
  const auto hash = body.state_hash();
  state.v.assign(5, {-1, -2, 3});
  body.set_state(state);
  EXPECT_NE(body.state_hash(), hash);
  state.v.assign(5, {1, 2, 3});
  body.set_state(state);
  EXPECT_EQ(body.state_hash(), hash);
}

TEST(BodyOfMixedCells, SharesTheMassOfACellAmongItsNodes) {
  const auto body = build_body<Map3, Held::by_one_dart>(problem_of(mixed_cells()));
  expect_equal_masses(body);
  EXPECT_EQ(body.springs.size(), 24u);
}

TEST(BodyOfASurface, HasAreasForMassesAndFacesForCells) {
  const auto body = build_body<Map2, Held::by_every_dart>(problem_of(quadrilateral_grid(3, 2)));
  expect_equal_masses(body);
  EXPECT_EQ(body.cell_mass.size(), 6u);
  for_each_cell<1>(body.map, [&](Edge e) {
    EXPECT_EQ(body.springs[body.edge(body.map, e.dart)].stiffness, body.map.is_free<2>(e.dart) ? 50.0 : 100.0);
  });
}

// A left-handed tetrahedron has its volume too.
TEST(BodyOfALeftHandedCell, HasAPositiveMass) {
  Mesh mesh = regular_tetrahedron();
  std::swap(mesh.nodes[0], mesh.nodes[1]);
  EXPECT_DOUBLE_EQ((build_body<TetMap, Held::by_one_dart>(problem_of(mesh)).cell_mass[0]), 1000.0 * 8 / 3);
}

// The middle layer of 2 x 2 x 3 cubes without two diagonal ones: the edge in the middle has two fans of cells around it
// and each of its ends is one vertex. It is two edges of the map, two springs in parallel: k = k1 + k2.
TEST(BodyPinchedAlongAnEdge, HasTwoSpringsBetweenTheSameVertices) {
  const Mesh grid = hexahedron_box(2, 2, 3, 1.0);
  Mesh mesh;
  mesh.points = grid.points;
  for (std::size_t c = 0; c < 12; ++c)
    if (c != 4 && c != 7) mesh.add_cell(CellKind::hexahedron, grid.cell(c));
  const auto body = build_body<Map3, Held::by_one_dart>(problem_of(mesh));
  int met = 0;
  for_each_cell<1>(body.map, [&](Edge e) {
    const auto a = body.vertices.position[body.vertex(body.map, e.dart)];
    const auto b = body.vertices.position[body.vertex(body.map, body.map.alpha<0>(e.dart))];
    if ((a + b) / 2 != Eigen::Vector3d(1, 1, 1.5)) return;
    ++met;
    EXPECT_EQ(body.springs[body.edge(body.map, e.dart)].stiffness, 50.0);
  });
  EXPECT_EQ(met, 2);
}

struct BadInput {
  const char* name;
  const char* expected;  // in the message
  std::function<void(Problem&)> spoil;
};
void PrintTo(const BadInput& bad, std::ostream* os) { *os << bad.name; }
class BadProblem : public testing::TestWithParam<BadInput> {};
TEST_P(BadProblem, IsRefusedByName) {
  Problem problem = problem_of(unequal_tetrahedra());
  GetParam().spoil(problem);
  try {
    build_body<TetMap, Held::by_one_dart>(problem);
    FAIL() << "no InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().expected), std::string::npos) << error.what();
  }
}
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(
    Each, BadProblem,
    testing::Values(
        BadInput{"zero_density", "density is 0", [](Problem& p) { p.material.density = 0; }},
        BadInput{"infinite_density", "density is inf", [](Problem& p) { p.material.density = inf; }},
        BadInput{"negative_stiffness", "stiffness is -1", [](Problem& p) { p.material.stiffness = -1; }},
        BadInput{"nan_damping", "damping is nan", [](Problem& p) { p.material.damping = nan; }},
        BadInput{"negative_viscosity", "viscosity is -0.5", [](Problem& p) { p.material.viscosity = -0.5; }},
        BadInput{"nan_gravity", "gravity is nan", [](Problem& p) { p.surroundings.gravity.y() = nan; }},
        BadInput{"nan_point", "point 3 is not finite", [](Problem& p) { p.mesh.points[3].x() = nan; }},
        BadInput{"fixed_point", "fixed point 5 does not exist", [](Problem& p) { p.fixed = {5}; }},
        BadInput{"velocities", "4 initial velocities for 5 points",
                 [](Problem& p) { p.initial_velocity.assign(4, Eigen::Vector3d(0, 0, 0)); }},
        BadInput{"infinite_velocity", "velocity is not finite",
                 [](Problem& p) { p.initial_velocity.assign(5, Eigen::Vector3d(0, inf, 0)); }},
        BadInput{"flat_cell", "mass of cell 0 is 0", [](Problem& p) { p.mesh.points[3].z() = 0; }},
        BadInput{"huge_cell", "mass of cell 0 is inf",
                 [](Problem& p) {
                   for (auto& x : p.mesh.points) x *= 1e120;
                 }},
        BadInput{"lonely_point", "point 5 belongs to no cell", [](Problem& p) { p.mesh.points.emplace_back(9, 9, 9); }},
        BadInput{"cells_at_a_vertex", "point 0 is more than one vertex",
                 [](Problem& p) {
                   p.mesh.points.insert(p.mesh.points.end(), {{-1, 0, 0}, {0, -1, 0}, {-1, -1, -1}});
                   p.mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 5, 6, 7});
                 }}),
    [](const auto& bad) { return bad.param.name; });

TEST(BodyState, OfAnotherSizeIsRefused) {
  auto body = build_body<TetMap, Held::by_one_dart>(problem_of(unequal_tetrahedra()));
  EXPECT_THROW(body.set_state({std::vector<Eigen::Vector3d>(4), std::vector<Eigen::Vector3d>(5)}), InputError);
}

TEST(BodyOfASurface, WeighsItsAreaTimesItsDensity) {
  Mesh square;
  square.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  square.add_cell(CellKind::quadrilateral, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  const auto body = build_body<Map2, Held::by_one_dart>(problem_of(square));
  EXPECT_EQ(body.cell_mass[0], 4.0 * body.material.density);
}

}  // namespace
}  // namespace dartboard::mass_spring_body_test
