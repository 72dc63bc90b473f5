// Embeddings and cell arrays that follow operations, against counts, sums and rebuilding, after every one.

#include "core/mechanics/adapt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/operations/tear_fan.h"
#include "core/plain/error.h"
#include "core/topology/check.h"
#include "core/walks/cell_arrays.h"
#include "tests/support/body_expectations.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::adapt_test {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

Problem box(int n) {
  Problem problem;
  problem.mesh = kuhn_grid(n, n, n, 0.125, 0.2, 3);
  problem.material = {.density = 1000.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  for (const auto& p : problem.mesh.points) problem.initial_velocity.push_back(p.cwiseProduct(p));
  return problem;
}

template <class Map>
void expect_consistent_and_stiff(const Body<Map>& body, const CellArrays& arrays) {
  expect_consistent(body, arrays);
  // k = 4 and c = 1/4: sums of small multiples of powers of two, exact
  double stiffness = 0.0, damping = 0.0;
  for (const Spring& s : body.springs) {
    stiffness += s.stiffness;
    damping += s.damping;
  }
  ASSERT_EQ(stiffness, 4.0 * 6.0 * static_cast<double>(body.cell_mass.size()));
  ASSERT_EQ(damping, 0.25 * 6.0 * static_cast<double>(body.cell_mass.size()));
}

// Deterministic and the same everywhere.
struct Draw {
  std::uint32_t state = 1;
  std::uint32_t below(std::size_t n) {
    state = state * 1664525u + 1013904223u;
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(state) * n) >> 32);
  }
};

template <class Map>
Dart some_live_dart(const Map& map, Draw& draw) {
  for (;;)
    if (const Dart d{draw.below(map.capacity())}; map.is_live(d)) return d;
}

template <class Map>
struct Adapt : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Adapt, Solids);

TYPED_TEST(Adapt, SharesAVertexMassAndAnEdgeStiffnessBetweenTheParts) {
  Problem problem;
  problem.mesh = unequal_tetrahedra();
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  const auto masses = body.vertices.mass;
  Dart shared = no_dart;
  body.map.for_each_dart([&](Dart d) {
    if (!body.map.template is_free<3>(d)) shared = d;
  });
  adapt(body, dissociate_face(body.map, shared));
  ASSERT_EQ(body.vertices.size(), 8u);
  ASSERT_EQ(body.springs.size(), 12u);
  for (const Spring& s : body.springs) EXPECT_EQ(s.stiffness, problem.material.stiffness);  // k = k1 + k2
  // m = m1 + m2 up to the rounding of one addition
  for (std::uint32_t k = 5; k < 8; ++k) {
    std::uint32_t twin = 0;
    while (body.vertices.point[twin] != body.vertices.point[k]) ++twin;
    EXPECT_NEAR(body.vertices.mass[twin] + body.vertices.mass[k], masses[twin], masses[twin] * 0x1p-52);
  }
}

TYPED_TEST(Adapt, DuplicatesPositionAndVelocity) {
  Problem problem = box(1);
  problem.fixed = {0, 7};  // the diagonal of the cube, at which all its tetrahedra are
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  const auto before = body.vertices;
  Draw draw;
  for (int k = 0; k < 30; ++k) adapt(body, dissociate_face(body.map, some_live_dart(body.map, draw)));
  ASSERT_GT(body.vertices.size(), before.size());
  int held = 0;
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
    std::uint32_t origin = 0;
    while (before.point[origin] != body.vertices.point[k]) ++origin;
    EXPECT_EQ(body.vertices.position[k], before.position[origin]);
    EXPECT_EQ(body.vertices.velocity[k], before.velocity[origin]);
    EXPECT_EQ(body.vertices.fixed[k], before.fixed[origin]);
    held += body.vertices.fixed[k];
  }
  EXPECT_GT(held, 2);
}

TYPED_TEST(Adapt, StaysConsistentThroughDissociations) {
  auto body = build_body<TypeParam, Held::by_every_dart>(box(2));
  CellArrays arrays;
  arrays.rebuild(body);
  Draw draw;
  for (int k = 0; k < 150; ++k) {
    arrays.apply(body, adapt(body, dissociate_face(body.map, some_live_dart(body.map, draw))));
    expect_consistent_and_stiff(body, arrays);
    if (this->HasFatalFailure()) FAIL() << "after dissociation " << k;
  }
}

TYPED_TEST(Adapt, StaysConsistentWhileEveryVolumeIsRemoved) {
  auto body = build_body<TypeParam, Held::by_every_dart>(box(2));
  CellArrays arrays;
  arrays.rebuild(body);
  Draw draw;
  while (body.map.dart_count() > 0) {
    arrays.apply(body, adapt(body, remove_volume(body.map, some_live_dart(body.map, draw))));
    expect_consistent_and_stiff(body, arrays);
    if (this->HasFatalFailure()) FAIL() << body.cell_mass.size() << " volumes left";
  }
  EXPECT_EQ(body.vertices.size(), 0u);
  EXPECT_EQ(body.springs.size(), 0u);
}

TYPED_TEST(Adapt, StaysConsistentThroughTearsAndSeriesOfOperations) {
  auto body = build_body<TypeParam, Held::by_every_dart>(box(3));
  CellArrays arrays;
  arrays.rebuild(body);
  Draw draw;
  for (int k = 0; k < 30; ++k) {
    TopologyChange change = tear_fan(body.map, some_live_dart(body.map, draw));
    change.append(remove_volume(body.map, some_live_dart(body.map, draw)));
    change.append(dissociate_face(body.map, some_live_dart(body.map, draw)));
    arrays.apply(body, adapt(body, change));
    expect_consistent_and_stiff(body, arrays);
    if (this->HasFatalFailure()) FAIL() << "after series " << k;
  }
}

TYPED_TEST(Adapt, OfNothingChangesNothing) {
  auto body = build_body<TypeParam, Held::by_every_dart>(box(1));
  const ChangedEmbeddings changed = adapt(body, TopologyChange{});
  EXPECT_TRUE(changed.vertices.empty() && changed.edges.empty() && changed.faces.empty() && changed.cells.empty());
}

TYPED_TEST(Adapt, TakesAwayExactlyTheRemovedMass) {
  auto body = build_body<TypeParam, Held::by_every_dart>(box(2));
  const auto total = [&] { return std::accumulate(body.vertices.mass.begin(), body.vertices.mass.end(), 0.0); };
  const double before = total(), removed = body.cell_mass[body.cell(body.map, Dart{0})];
  adapt(body, remove_volume(body.map, Dart{0}));
  EXPECT_NEAR(total(), before - removed, before * 0x1p-44);  // 27 sums of at most 24 terms: gamma_(2^8)
}

TYPED_TEST(Adapt, LeavesABodyThatHasNoStateByMeshPoint) {
  Problem problem;
  problem.mesh = unequal_tetrahedra();
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  adapt(body, remove_volume(body.map, Dart{0}));
  EXPECT_THROW(body.state(), InputError);
  EXPECT_THROW(body.set_state({}), InputError);
  EXPECT_NE(body.state_hash(), 0u);
}

}  // namespace
}  // namespace dartboard::adapt_test
