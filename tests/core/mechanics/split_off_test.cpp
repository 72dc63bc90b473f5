// A component that becomes a body of its own: the parts sum to the whole and move as before.

#include "core/mechanics/split_off.h"

#include <gtest/gtest.h>

#include <map>

#include "core/mechanics/refine.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/walks/runge_kutta_4.h"
#include "tests/support/body_expectations.h"

namespace dartboard::split_off_test {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

// Three boxes of 1, 2 and 3 cubes, set in motion under a gravity of its own; the second hangs from two of its points.
template <class Map>
Body<Map> three_boxes() {
  Problem problem;
  problem.mesh = several_components(3);
  problem.material = {.density = 1000.0, .stiffness = 4.0e5, .damping = 20.0, .viscosity = 0.5};
  problem.surroundings.gravity = {1.0, 2.0, -3.0};
  problem.fixed = {8, 9};
  for (const auto& p : problem.mesh.points)
    problem.initial_velocity.emplace_back(p.y() * p.z(), 0.5 * p.z(), -0.25 * p.x());
  return build_body<Map, Held::by_every_dart>(problem);
}

template <class Map>
void move(Body<Map>& body, int steps) {
  CellArrays arrays;
  arrays.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < steps; ++k) integrator.step(arrays, body, 1e-3);
}

template <class Map>
struct SplitOffBody : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SplitOffBody, Solids);

TYPED_TEST(SplitOffBody, LeavesTwoConsistentBodies) {
  auto body = three_boxes<TypeParam>();
  CellArrays arrays, part_arrays;
  arrays.rebuild(body);
  const auto cells = body.cell_dart.size();
  auto split = split_off(body, body.cell_dart[6]);  // in the box of two cubes
  arrays.apply(body, split.changed);
  part_arrays.rebuild(split.part);
  expect_consistent(body, arrays);
  expect_consistent(split.part, part_arrays);
  EXPECT_EQ(split.part.cell_dart.size(), 12u);
  EXPECT_EQ(body.cell_dart.size(), cells - 12u);
}

TYPED_TEST(SplitOffBody, MovesThePartBitForBitAsTheWholeDid) {
  auto whole = three_boxes<TypeParam>(), body = whole;
  auto part = split_off(body, body.cell_dart[6]).part;
  std::map<std::uint32_t, std::uint32_t> of_point;
  for (std::uint32_t k = 0; k < whole.vertices.size(); ++k) of_point[whole.vertices.point[k]] = k;
  move(whole, 100);
  move(part, 100);
  for (std::uint32_t k = 0; k < part.vertices.size(); ++k) {
    const std::uint32_t there = of_point.at(part.vertices.point[k]);
    ASSERT_EQ(part.vertices.position[k], whole.vertices.position[there]);
    ASSERT_EQ(part.vertices.velocity[k], whole.vertices.velocity[there]);
    ASSERT_EQ(part.vertices.fixed[k], whole.vertices.fixed[there]);
  }
}

// A refined body contributes stiffness by shares; the part needs them to come apart later.
TYPED_TEST(SplitOffBody, TakesAlongTheSharesOfWhatWasRefined) {
  auto body = three_boxes<TypeParam>();
  refine(body, Volume{body.cell_dart[8]}, 0.5);
  auto part = split_off(body, body.cell_dart[6]).part;
  CellArrays arrays;
  arrays.rebuild(part);
  EXPECT_EQ(part.cell_dart.size(), 12u + 3u);
  expect_consistent(part, arrays);
}

TYPED_TEST(SplitOffBody, RemembersWhichOfItsCellsWereListedInsideOut) {
  auto body = three_boxes<TypeParam>();
  for (std::size_t c = 0; c < body.cell_inside_out.size(); ++c) body.cell_inside_out[c] = c % 3 == 0;
  std::vector<std::uint8_t> expected(body.cell_inside_out.begin() + 6, body.cell_inside_out.begin() + 18);
  EXPECT_EQ(split_off(body, body.cell_dart[6]).part.cell_inside_out, expected);
}

TYPED_TEST(SplitOffBody, SharesMassMomentumAndSpringsOut) {
  auto body = three_boxes<TypeParam>();
  std::multimap<double, int> masses, springs;
  const auto count = [&masses, &springs](const Body<TypeParam>& b, int sign) {
    for (const double m : b.vertices.mass) masses.emplace(m, sign);
    for (const Spring& s : b.springs) springs.emplace(s.stiffness * s.rest_length, sign);
  };
  count(body, 1);
  const auto split = split_off(body, body.cell_dart[0]);
  count(body, -1);
  count(split.part, -1);
  // vertex by vertex and spring by spring: each of the whole is in one of the two, with the same bits
  for (const auto* list : {&masses, &springs}) {
    std::map<double, int> balance;
    for (const auto& [value, sign] : *list) balance[value] += sign;
    for (const auto& [value, n] : balance) EXPECT_EQ(n, 0) << value;
  }
}

TYPED_TEST(SplitOffBody, LeavesAnEmptyBodyBehindTheLastComponent) {
  auto body = three_boxes<TypeParam>();
  for (int k = 0; k < 3; ++k) split_off(body, body.cell_dart[0]);
  EXPECT_EQ(body.map.dart_count(), 0u);
  EXPECT_EQ(body.vertices.size(), 0u);
  EXPECT_EQ(body.springs.size(), 0u);
  EXPECT_EQ(body.face_dart.size(), 0u);
  EXPECT_THROW(split_off(body, Dart{0}), TopologyError);
}

TEST(SplitOffSheet, IsCutAlongEdges) {
  Problem problem;
  problem.mesh = quad_sheet(4, 1, 1.0);
  auto body = build_body<Map2, Held::by_every_dart>(problem);
  Dart middle = no_dart;  // the edge x = 2
  for (const Dart d : body.edge_dart) {
    const auto &a = body.vertices.position[body.vertex(body.map, d)],
               &b = body.vertices.position[body.vertex(body.map, body.map.alpha<0>(d))];
    if (a.x() == 2.0 && b.x() == 2.0) middle = d;
  }
  adapt(body, dissociate_edge(body.map, middle));
  const auto split = split_off(body, middle);
  EXPECT_EQ(split.part.cell_mass.size(), 2u);
  EXPECT_EQ(body.cell_mass.size(), 2u);
  EXPECT_EQ(split.part.vertices.size(), 6u);
  EXPECT_EQ(check(split.part.map), "");
}

}  // namespace
}  // namespace dartboard::split_off_test
