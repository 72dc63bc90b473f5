// Conservative refinement: counts, conserved sums, forces of affine deformations, and operations after a refinement.

#include "core/mechanics/refine.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/operations/dissociate_face.h"
#include "core/operations/remove_volume.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/topology/summary.h"
#include "core/walks/spring_forces.h"
#include "tests/support/body_expectations.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::refine_test {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

template <class Map>
Body<Map> box(int n) {
  Problem problem;
  problem.mesh = kuhn_grid(n, n, n, 0.125, 0.1, 5);
  problem.material = {.density = 1000.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  for (const auto& p : problem.mesh.points) problem.initial_velocity.push_back(p.cwiseProduct(p));
  return build_body<Map, Held::by_every_dart>(problem);
}

template <class Map>
ChangedEmbeddings refine_any(Body<Map>& body, int dimension, Dart d, double bracing) {
  if (dimension == 1) return refine(body, Edge{d}, bracing);
  if (dimension == 2) return refine(body, Face{d}, bracing);
  return refine(body, Volume{d}, bracing);
}

/// Do the faces of a cell, walked along alpha_0 alpha_1 from its dart, run clockwise seen from outside?
template <class Map>
bool runs_inside_out(const Body<Map>& body, Dart d) {
  const Map& map = body.map;
  const auto at = [&](Dart e) { return body.vertices.position[body.vertex(map, e)]; };
  const Dart next = map.template alpha<0, 1>(d);  // at the next corner of the face
  const Eigen::Vector3d a = at(d), b = at(next), c = at(map.template alpha<0, 1>(next)),
                        tip = at(map.template alpha<2, 1, 0>(d));
  return (b - a).cross(c - a).dot(tip - a) > 0.0;
}

template <class Body>
double total_mass(const Body& body) {
  double sum = 0.0;
  for (const double m : body.cell_mass) sum += m;
  return sum;
}

template <class Body>
Eigen::Vector3d total_momentum(const Body& body) {
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t k = 0; k < body.vertices.size(); ++k) sum += body.vertices.mass[k] * body.vertices.velocity[k];
  return sum;
}

// Forces of the springs at vertex positions A x + b of the present ones, velocities zero; positions stay deformed.
template <class Map>
std::vector<Eigen::Vector3d> affine_forces(Body<Map>& body, const Eigen::Matrix3d& a) {
  for (auto& x : body.vertices.position) x = a * x + Eigen::Vector3d(0.25, -0.5, 1.0);
  for (auto& v : body.vertices.velocity) v.setZero();
  for (auto& f : body.vertices.force) f.setZero();
  CellArrays arrays;
  arrays.rebuild(body);
  add_spring_forces(arrays, body);
  return body.vertices.force;
}

template <class Map>
struct Refine : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Refine, Solids);

TYPED_TEST(Refine, MakesFourTetrahedraOfOne) {
  Problem problem;
  problem.mesh = regular_tetrahedron();
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  refine(body, Volume{body.cell_dart[0]}, 1.0);
  EXPECT_EQ(body.vertices.size(), 5u);
  EXPECT_EQ(body.springs.size(), 10u);
  EXPECT_EQ(body.face_dart.size(), 10u);
  EXPECT_EQ(body.cell_dart.size(), 4u);
  EXPECT_EQ(body.vertices.position[4], Eigen::Vector3d(0, 0, 0));  // the corners add to zero, exactly
  EXPECT_EQ(body.vertices.point[4], no_point);
}

TYPED_TEST(Refine, GivesTheNewSpringsTheirLengthAtRest) {
  Problem problem;
  problem.mesh = regular_tetrahedron();  // edges of sqrt(8), corners sqrt(3) from the centre
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  for (auto& x : body.vertices.position) x *= 7.0;  // the rest shape is not the present one
  refine(body, Volume{body.cell_dart[0]}, 1.0);
  for (const std::uint32_t e : {6u, 7u, 8u, 9u})
    // three squares of roots and their sums: within some units in the last place
    EXPECT_NEAR(body.springs[e].rest_length, std::sqrt(3.0), 8 * 0x1p-52);
}

TYPED_TEST(Refine, SplitsAnEdgeIntoSpringsInSeries) {
  Problem problem;
  problem.mesh = unequal_tetrahedra();
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  Dart shared = no_dart;  // of an edge around which both tetrahedra lie
  for (const Dart d : body.edge_dart)
    if (incident_cells<3>(body.map, Edge{d}).size() == 2) shared = d;
  const std::uint32_t e = body.edge(body.map, shared);
  const Spring whole = body.springs[e];
  refine(body, Edge{shared}, 0.0);
  EXPECT_EQ(body.cell_dart.size(), 4u);
  EXPECT_EQ(body.vertices.size(), 6u);
  EXPECT_EQ(body.springs.size(), 9u + 1 + 3);  // half the edge, and one towards each of the three points across
  std::size_t halves = 0, slack = 0;
  for (const Spring& s : body.springs) {
    halves +=
        s.rest_length == whole.rest_length / 2 && s.stiffness == 2 * whole.stiffness && s.damping == 2 * whole.damping;
    slack += s.stiffness == 0.0;
  }
  EXPECT_EQ(halves, 2u);
  EXPECT_EQ(slack, 3u);
}

TYPED_TEST(Refine, StaysConsistentThroughRandomRefinementsDissociationsAndRemovals) {
  auto body = box<TypeParam>(2);
  CellArrays arrays;
  arrays.rebuild(body);
  SplitMix64 random(7);
  for (int k = 0; k < 200; ++k) {
    const Dart d = some_live_dart(body.map, random);
    const std::uint32_t what = random.below(5);
    if (what == 0)
      arrays.apply(body, adapt(body, dissociate_face(body.map, d)));
    else if (what == 1 && body.cell_dart.size() > 1)
      arrays.apply(body, adapt(body, remove_volume(body.map, d)));
    else
      arrays.apply(body, refine_any(body, 1 + static_cast<int>(random.below(3)), d, 0.5));
    expect_consistent(body, arrays);
    if (this->HasFatalFailure()) FAIL() << "after operation " << k;
  }
}

// Cells of both kinds, and refined ones refined again: the corners, too, show the sense of the walk from each dart.
TYPED_TEST(Refine, KnowsWhichWayTheFacesOfACellRun) {
  Problem problem;
  problem.mesh = kuhn_grid(1, 1, 1, 1.0);
  Mesh mirrored;
  mirrored.points = problem.mesh.points;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    const auto nodes = problem.mesh.cell(c);
    std::array<std::uint32_t, 4> turned{nodes[0], nodes[1], nodes[2], nodes[3]};
    if (c % 2 != 0) std::swap(turned[2], turned[3]);
    mirrored.add_cell(CellKind::tetrahedron, turned);
  }
  problem.mesh = mirrored;
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  SplitMix64 random(3);
  std::set<bool> seen;
  for (int k = 0; k < 30; ++k) {
    refine_any(body, 1 + static_cast<int>(random.below(3)), some_live_dart(body.map, random), 1.0);
    for (std::size_t c = 0; c < body.cell_dart.size(); ++c) {
      const bool inside_out = runs_inside_out(body, body.cell_dart[c]);
      seen.insert(inside_out);
      ASSERT_EQ(body.cell_inside_out[c] != 0, inside_out) << "cell " << c << " after " << k + 1;
    }
  }
  EXPECT_EQ(seen.size(), 2u);
}

TYPED_TEST(Refine, KeepsTheCharacteristicsOfTheBody) {
  auto body = box<TypeParam>(2);
  SplitMix64 random(3);
  const auto before = summarize(body.map);
  for (int k = 0; k < 60; ++k) refine_any(body, 1 + k % 3, some_live_dart(body.map, random), 1.0);
  const auto after = summarize(body.map);
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.orientable, before.orientable);
}

TYPED_TEST(Refine, KeepsMassAndMomentum) {
  auto body = box<TypeParam>(2);
  const double mass = total_mass(body);
  const Eigen::Vector3d momentum = total_momentum(body);
  double absolute = 0.0;
  for (std::size_t k = 0; k < body.vertices.size(); ++k)
    absolute += body.vertices.mass[k] * body.vertices.velocity[k].norm();
  SplitMix64 random(11);
  for (int k = 0; k < 100; ++k) refine_any(body, 1 + k % 3, some_live_dart(body.map, random), 1.0);
  // Each refinement divides masses and velocities a few times; then sums of fewer than 2^9 terms, each with fewer than
  // 2^6 roundings of its own and 100 refinements at most in its ancestry: below 2^11 u.
  EXPECT_NEAR(total_mass(body), mass, mass * 0x1p-42);
  EXPECT_LE((total_momentum(body) - momentum).norm(), absolute * 0x1p-42);
}

TYPED_TEST(Refine, KeepsForcesOfAffineDeformationsWithoutBracing) {
  Eigen::Matrix3d a;
  a << 1.25, 0.125, 0.0, -0.25, 0.75, 0.5, 0.0625, 0.0, 1.5;
  auto whole = box<TypeParam>(1), refined = whole;
  SplitMix64 random(2);
  for (int k = 0; k < 12; ++k) refine_any(refined, 1 + k % 3, some_live_dart(refined.map, random), 0.0);
  const auto expected = affine_forces(whole, a), actual = affine_forces(refined, a);
  double largest = 0.0;
  for (const Spring& s : whole.springs) largest = std::max(largest, s.stiffness * s.rest_length);
  // Every vertex sums at most 32 forces of some such size; positions of midpoints of midpoints carry 12 roundings of
  // numbers near 2, over edges no shorter than 2^-4 halved some times: below 2^12 u relative to the force.
  const double bound = 32 * largest * 0x1p-40;
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_LE((actual[k] - expected[k]).norm(), bound) << k;
  for (std::size_t k = expected.size(); k < actual.size(); ++k) EXPECT_LE(actual[k].norm(), bound) << k;
}

TYPED_TEST(Refine, StaysAtRestWithBracing) {
  auto body = box<TypeParam>(1);
  SplitMix64 random(4);
  for (int k = 0; k < 9; ++k) refine_any(body, 1 + k % 3, some_live_dart(body.map, random), 1.0);
  for (const auto& f : affine_forces(body, Eigen::Matrix3d::Identity()))
    EXPECT_LE(f.norm(), 32 * 4.0 * 0x1p-46);  // k times roundings of lengths below 1, over fewer than 32 springs
}

TYPED_TEST(Refine, FixesAVertexBetweenFixedOnes) {
  Problem problem;
  problem.mesh = regular_tetrahedron();
  problem.fixed = {0, 1};
  auto body = build_body<TypeParam, Held::by_every_dart>(problem);
  const auto between = [&body](std::uint8_t fixed_ends) {
    for (const Dart d : body.edge_dart) {
      const auto& v = body.vertices;
      const int ends =
          v.fixed[body.vertex(body.map, d)] + v.fixed[body.vertex(body.map, body.map.template alpha<0>(d))];
      if (ends == fixed_ends) return d;
    }
    return no_dart;
  };
  refine(body, Edge{between(2)}, 1.0);
  EXPECT_EQ(body.vertices.fixed[4], 1);
  refine(body, Edge{between(1)}, 1.0);
  EXPECT_EQ(body.vertices.fixed[5], 0);
}

TYPED_TEST(Refine, PutsAVertexAtRestAmongThoseOfItsCellAtRest) {
  for (const int dimension : {1, 2, 3}) {
    auto body = box<TypeParam>(1);
    body.vertices.keep_rest();
    for (auto& x : body.vertices.position) x = 3.0 * x.cwiseProduct(x) + Eigen::Vector3d(5, -7, 9);
    const Dart d = body.cell_dart[2];
    std::set<std::uint32_t> corners{body.vertex(body.map, d), body.vertex(body.map, body.map.template alpha<0>(d))};
    if (dimension > 1) corners.insert(body.vertex(body.map, body.map.template alpha<1, 0>(d)));
    if (dimension > 2) corners.insert(body.vertex(body.map, body.map.template alpha<2, 1, 0>(d)));
    ASSERT_EQ(corners.size(), dimension + 1u);
    Eigen::Vector3d mean(0, 0, 0);
    for (const std::uint32_t k : corners) mean += body.vertices.rest[k] / (dimension + 1.0);
    const auto before = body.vertices.rest;
    refine_any(body, dimension, d, 1.0);
    ASSERT_EQ(body.vertices.rest.size(), before.size() + 1);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), body.vertices.rest.begin()));
    EXPECT_LE((body.vertices.rest.back() - mean).norm(), 8 * 0x1p-53);  // places below 1, four roundings either way
  }
}

TYPED_TEST(Refine, RefusesABracingBelowZero) {
  auto body = box<TypeParam>(1);
  const auto subdivision = subdivide(body.map, Volume{body.cell_dart[0]});
  EXPECT_THROW(adapt(body, subdivision, -1.0), InputError);
  EXPECT_THROW(adapt(body, subdivision, std::numeric_limits<double>::quiet_NaN()), InputError);
}

}  // namespace
}  // namespace dartboard::refine_test
