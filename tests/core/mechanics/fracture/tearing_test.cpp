#include "core/mechanics/fracture/tearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/stress.h"
#include "core/operations/remove_volume.h"
#include "core/plain/error.h"
#include "core/topology/check.h"
#include "core/topology/summary.h"
#include "core/walks/cell_arrays.h"
#include "tests/support/rotation_for_tests.h"
#include "tests/support/torn_body_for_tests.h"

namespace dartboard::tearing_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace torn_body;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

template <class Map>
struct Tearing : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Tearing, Solids);

// ---- the starting face

// The oracle goes over all faces of the body. |n . direction| rounds by some ten u, and 24 bits are kept of it.
TYPED_TEST(Tearing, StartsWithTheFaceWhoseNormalBestApproximatesTheDirection) {
  const auto body = body_of<TypeParam>(jittered_box());
  for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(1, -2, 3), Vector3d(-1e-3, 0, 0)}) {
    std::vector<double> best(body.vertices.size(), -1.0);
    for (const Dart face : body.face_dart) {
      if (body.map.template is_free<3>(face)) continue;
      const double alignment = std::abs(normal_of(body, face).dot(direction.normalized()));
      for (const Vertex v : incident_cells<0>(body.map, Face{face})) {
        double& b = best[body.vertex(body.map, v.dart)];
        b = std::max(b, alignment);
      }
    }
    for (std::uint32_t k = 0; k < best.size(); ++k) {
      const Dart start = starting_face(body, k, direction);
      if (best[k] < 0.0) {
        ASSERT_EQ(start, no_dart);
        continue;
      }
      ASSERT_FALSE(body.map.template is_free<3>(start));
      ASSERT_EQ(body.vertex(body.map, start), k);
      ASSERT_NEAR(std::abs(normal_of(body, start).dot(direction.normalized())), best[k], 0x1p-23);
    }
  }
}

TYPED_TEST(Tearing, StartsWithTheSameFaceHoweverARegularBodyLies) {
  const auto body = body_of<TypeParam>(kuhn_grid(3, 3, 3, 0.5));
  for (const Matrix3d& turn : some_rotations()) {
    auto turned = body;
    move(turned, turn);
    for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(0, 1, 1), Vector3d(1, 2, 3)})
      for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
        EXPECT_EQ(starting_face(turned, k, turn * direction), starting_face(body, k, direction));
  }
}

TYPED_TEST(Tearing, StartsOnlyWithAFaceThatTheFilterAccepts) {
  const auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 0.5));
  std::uint32_t middle = 0;
  while (body.vertices.position[middle] != Vector3d(0.5, 0.5, 0.5)) ++middle;
  const Dart best = starting_face(body, middle, {0, 0, 1});
  const auto second = starting_face(body, middle, {0, 0, 1}, [&](Dart d) { return !same_cell<2>(body.map, d, best); });
  EXPECT_NE(second, no_dart);
  EXPECT_FALSE(same_cell<2>(body.map, second, best));
  EXPECT_EQ(starting_face(body, middle, {0, 0, 1}, [](Dart) { return false; }), no_dart);
}

TYPED_TEST(Tearing, StartsOnlyWithAFaceThatIsAlignedWellEnough) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());  // the face between them lies in the plane z = 0
  const auto start = [&](const Vector3d& direction, double least) {
    return starting_face(body, 0, direction, {}, least);
  };
  EXPECT_NE(start({0, 0, 2}, 1.0), no_dart);
  EXPECT_NE(start({0, 3, 4}, 0.79), no_dart);
  EXPECT_EQ(start({0, 3, 4}, 0.81), no_dart);
  EXPECT_NE(start({1, 0, 0}, 0.0), no_dart);
}

TYPED_TEST(Tearing, DoesNotStartWithADegenerateFace) {
  auto body = body_of<TypeParam>(unequal_tetrahedra());
  ASSERT_NE(starting_face(body, 0, {0, 0, 1}), no_dart);
  for (std::uint32_t k = 0; k < 5; ++k)
    if (body.vertices.point[k] == 2) body.vertices.position[k] = {0.5, 0, 0};  // the triangle 0 1 2 is a segment now
  for (std::uint32_t k = 0; k < 5; ++k) EXPECT_EQ(starting_face(body, k, {0, 0, 1}), no_dart);
}

TYPED_TEST(Tearing, StartsInADirectionOnly) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());
  EXPECT_THROW(starting_face(body, 0, {0, 0, 0}), InputError);
  EXPECT_THROW(starting_face(body, 0, {0, 0, std::numeric_limits<double>::infinity()}), InputError);
}

// ---- tearing

// Uniform stress of 4 k (s - 1) / a (stress_test.cpp): 16 Pa with k = 4, s = 3/2, a = 1/2.
TEST(TearingOfHexahedra, PartsAStretchedBarIntoLayersAcrossTheStretch) {
  Torn<Map3> bar(body_of<Map3>(hexahedron_box(2, 2, 3, 0.5)));
  move(bar.body, along_z);
  EXPECT_EQ(bar.tear({.threshold = 16.5}).stressed, 0u);
  EXPECT_EQ(bar.followed, 0u);
  const TornVertices torn = bar.tear({.threshold = 15.5});
  EXPECT_NEAR(torn.largest_stress, 16, 16 * 128 * u);
  EXPECT_EQ(torn.stressed, 9u * 4u);
  EXPECT_EQ(torn.faces, 8u);  // two layers between three
  EXPECT_EQ(torn.tears, bar.followed);
  for (const Vector3d& n : bar.normals) EXPECT_EQ(n.cwiseAbs(), Vector3d(0, 0, 1));
  EXPECT_EQ(components(bar.body.map).count, 3u);
  // the layers have the same stress, and no face across it left
  EXPECT_EQ(bar.tear({.threshold = 15.5}).tears, 0u);
  EXPECT_GT(bar.tear({.threshold = 15.5, .least_alignment = 0.0}).tears, 0u);
}

TYPED_TEST(Tearing, ChoosesFacesAcrossTheStretch) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, along_z);
  double all = 0.0, torn = 0.0;
  std::size_t interior = 0;
  for (const Dart face : bar.body.face_dart)
    if (!bar.body.map.template is_free<3>(face)) {
      all += std::abs(normal_of(bar.body, face).z());
      ++interior;
    }
  ASSERT_GT(bar.tear({.threshold = 1.0, .most_per_step = 5}).tears, 0u);
  for (const Vector3d& n : bar.normals) torn += std::abs(n.z());
  EXPECT_GT(torn / static_cast<double>(bar.normals.size()), all / static_cast<double>(interior));
  EXPECT_GT(bar.vertices_apart, 0u);
}

template <class Map>
std::set<Triple> torn_faces(const Mesh& mesh, const Matrix3d& turn, std::size_t most = 1000) {
  Torn<Map> bar(body_of<Map>(mesh));
  move(bar.body, turn * along_z);
  for (int step = 0; step < 3; ++step) bar.tear({.threshold = 4.0, .most_per_step = most});
  return bar.faces;
}

TYPED_TEST(Tearing, TearsTheSameFacesHoweverTheBodyLies) {
  for (const Mesh& mesh : {jittered_box(), kuhn_grid(2, 2, 4, 0.5)}) {
    const auto upright = torn_faces<TypeParam>(mesh, Matrix3d::Identity(), 6);
    EXPECT_FALSE(upright.empty());
    for (const Matrix3d& turn : some_rotations()) EXPECT_EQ(torn_faces<TypeParam>(mesh, turn, 6), upright);
  }
}

TEST(TearingOfHexahedra, TearsTheSameFacesHoweverTheBodyLies) {
  const Mesh mesh = hexahedron_box(2, 2, 3, 0.5);
  const auto upright = torn_faces<Map3>(mesh, Matrix3d::Identity(), 2);
  EXPECT_FALSE(upright.empty());
  for (const Matrix3d& turn : some_rotations()) EXPECT_EQ(torn_faces<Map3>(mesh, turn, 2), upright);
}

TEST(TearingOfTetrahedra, TearsTheSameFacesInBothStorages) {
  EXPECT_EQ(torn_faces<Map3>(jittered_box(), Matrix3d::Identity()),
            torn_faces<TetMap>(jittered_box(), Matrix3d::Identity()));
}

TYPED_TEST(Tearing, KeepsMassAndStiffnessAndAValidBodyWithItsArrays) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, along_z);
  const auto mass = [&] { return std::accumulate(bar.body.vertices.mass.begin(), bar.body.vertices.mass.end(), 0.0); };
  const double before = mass();
  for (int step = 0; step < 10; ++step) {
    bar.tear({.threshold = 4.0});
    ASSERT_EQ(check(bar.body.map), "");
    // positive terms, 24 cells per vertex and at most 4 * 144 vertices: 2 (24 + 576) u < 2^-42
    ASSERT_NEAR(mass(), before, before * 0x1p-42);
    double stiffness = 0.0;
    for (const Spring& s : bar.body.springs) stiffness += s.stiffness;
    ASSERT_EQ(stiffness, 4.0 * 6.0 * static_cast<double>(bar.body.cell_mass.size()));
    CellArrays rebuilt;
    rebuilt.rebuild(bar.body);
    ASSERT_TRUE(bar.arrays == rebuilt);
  }
  EXPECT_GT(bar.followed, 0u);
}

TYPED_TEST(Tearing, TakesTheMostStressedFirstAndStopsAtTheMostPerStep) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, along_z);
  Torn<TypeParam> other = bar;
  const TornVertices one = bar.tear({.threshold = 1.0, .least_alignment = 0.0, .most_per_step = 1});
  EXPECT_EQ(one.tears, 1u);
  EXPECT_EQ(bar.followed, 1u);
  // the threshold just below the largest lets the same vertex tear and no other
  const TornVertices top = other.tear({.threshold = one.largest_stress * (1 - 0x1p-30), .least_alignment = 0.0});
  EXPECT_EQ(top.stressed, 1u);
  EXPECT_GT(one.stressed, 1u);
  Torn<TypeParam> same(body_of<TypeParam>(jittered_box()));
  move(same.body, along_z);
  EXPECT_EQ(same.tear({.threshold = one.largest_stress}).stressed, 0u);  // above, and not at
  EXPECT_EQ(top.largest_stress, one.largest_stress);
  EXPECT_EQ(other.faces, bar.faces);
  EXPECT_EQ(other.tear({.threshold = 1.0, .most_per_step = 0}).tears, 0u);
}

TYPED_TEST(Tearing, ReportsTheLargestPrincipalStressAndLeavesTheStresses) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, along_z);
  std::vector<double> principal;
  for (std::uint32_t k = 0; k < bar.body.vertices.size(); ++k)
    principal.push_back(principal_stress(vertex_stress(bar.body, k)).value);
  const TornVertices torn = bar.tear({.threshold = 5.0});
  EXPECT_EQ(torn.largest_stress, *std::max_element(principal.begin(), principal.end()));
  EXPECT_EQ(torn.stressed, static_cast<std::size_t>(
                               std::count_if(principal.begin(), principal.end(), [](double s) { return s > 5.0; })));
  ASSERT_EQ(bar.stress.size(), principal.size());
  for (std::size_t k = 0; k < principal.size(); ++k) EXPECT_EQ(principal_stress(bar.stress[k]).value, principal[k]);
}

TYPED_TEST(Tearing, ReportsTheLargestStressUnderPressureToo) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, 0.5 * Matrix3d::Identity());
  double largest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < bar.body.vertices.size(); ++k)
    largest = std::max(largest, principal_stress(vertex_stress(bar.body, k)).value);
  ASSERT_LT(largest, 0.0);
  EXPECT_EQ(bar.tear({.threshold = 1.0}).largest_stress, largest);
}

TYPED_TEST(Tearing, PassesOverTheVerticesOfASingleCell) {
  Torn<TypeParam> one(body_of<TypeParam>(regular_tetrahedron()));
  move(one.body, 3.0 * Matrix3d::Identity());
  const TornVertices torn = one.tear({.threshold = 1e-3, .least_alignment = 0.0});
  EXPECT_EQ(torn.stressed, 4u);
  EXPECT_EQ(torn.tears, 0u);
  EXPECT_EQ(one.followed, 0u);
}

TYPED_TEST(Tearing, DoesNotSpareFixedVertices) {
  const Mesh mesh = jittered_box();
  std::vector<std::uint32_t> every(mesh.points.size());
  std::iota(every.begin(), every.end(), 0u);
  Torn<TypeParam> free(body_of<TypeParam>(mesh)), fixed(body_of<TypeParam>(mesh, every));
  for (auto* bar : {&free, &fixed}) {
    move(bar->body, along_z);
    bar->tear({.threshold = 4.0});
  }
  EXPECT_FALSE(free.faces.empty());
  EXPECT_EQ(fixed.faces, free.faces);
}

TYPED_TEST(Tearing, LooksAgainAtTheStressWhenAVertexHasItsTurn) {
  auto body = body_of<TypeParam>(jittered_box());
  move(body, along_z);
  CellArrays arrays;
  arrays.rebuild(body);
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const EdgeEntry& edge : arrays.edges) ends.push_back(edge.ends);
  std::vector<Matrix3d> stress;
  const auto relax = [&](const TopologyChange& change) {
    adapt(body, change);
    move(body, 0.5 * Matrix3d::Identity());  // springs press now
  };
  const TornVertices torn = tear_where_stressed(body, ends, {.threshold = 4.0}, {}, relax, stress);
  EXPECT_GT(torn.stressed, 1u);
  EXPECT_EQ(torn.tears, 1u);
}

TYPED_TEST(Tearing, GoesOnWhileFollowingRemovesCells) {
  auto body = body_of<TypeParam>(jittered_box());
  move(body, along_z);
  CellArrays arrays;
  arrays.rebuild(body);
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const EdgeEntry& edge : arrays.edges) ends.push_back(edge.ends);
  std::vector<Matrix3d> stress;
  const std::size_t cells = body.cell_mass.size();
  std::size_t removed = 0;
  tear_where_stressed(
      body, ends, {.threshold = 4.0}, {},
      [&](TopologyChange change) {
        change.append(remove_volume(body.map, body.cell_dart.back()));
        adapt(body, change);
        ++removed;
      },
      stress);
  EXPECT_GT(removed, 1u);
  EXPECT_EQ(body.cell_mass.size(), cells - removed);
  EXPECT_EQ(check(body.map), "");
}

// ---- along a seam

TYPED_TEST(Tearing, AlongASeamTearsItsFacesOnlyAndInTheEndAllOfThem) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  const auto seam = faces_on_plane(bar.body, {0, 0, 1.0}, {0, 0, 1});
  std::set<Triple> of_seam;
  for (const Dart d : seam) of_seam.insert(points_of(bar.body, d));
  const FaceSet set(bar.body.map, seam);
  move(bar.body, along_z);
  const auto on_seam = [&](Dart d) { return set.contains(bar.body.map, d); };
  // no face of this seam is steeper than 80 degrees, and every vertex is under tension
  const TornVertices torn = bar.tear({.threshold = 0.25, .least_alignment = 0.0}, on_seam);
  EXPECT_EQ(torn.faces, seam.size());
  EXPECT_EQ(bar.faces, of_seam);
  EXPECT_EQ(components(bar.body.map).count, 2u);
  EXPECT_EQ(bar.tear({.threshold = 0.25, .least_alignment = 0.0}, on_seam).tears, 0u);
}

// The vertex in the middle has all the springs that pull, so that it is the most stressed one.
TYPED_TEST(Tearing, AlongASeamTakesThePieceOfItAroundTheVertex) {
  Torn<TypeParam> bar(body_of<TypeParam>(kuhn_grid(4, 4, 4, 0.5)));
  std::uint32_t middle = 0;
  while (bar.body.vertices.position[middle] != Vector3d(1, 1, 1)) ++middle;
  const std::uint32_t point = bar.body.vertices.point[middle];
  slacken_all_but_around(bar.body, middle);
  const auto seam = faces_on_plane(bar.body, {0, 0, 1.0}, {0, 0, 1});
  std::set<Triple> around;
  for (const Dart d : seam)
    if (const Triple t = points_of(bar.body, d); std::find(t.begin(), t.end(), point) != t.end()) around.insert(t);
  ASSERT_GT(around.size(), 3u);  // more than start and the faces that share an edge with it
  ASSERT_LT(around.size(), seam.size());
  const FaceSet set(bar.body.map, seam);
  move(bar.body, along_z);
  bar.tear({.threshold = 0.25, .most_per_step = 1}, [&](Dart d) { return set.contains(bar.body.map, d); });
  EXPECT_EQ(bar.faces, around);
  EXPECT_EQ(std::count(bar.body.vertices.point.begin(), bar.body.vertices.point.end(), point), 2);
}

// ---- refusals

TYPED_TEST(Tearing, RefusesARuleThatIsNone) {
  Torn<TypeParam> bar(body_of<TypeParam>(unequal_tetrahedra()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double threshold : {0.0, -1.0, nan}) EXPECT_THROW(bar.tear({.threshold = threshold}), InputError);
  for (const double least : {1.5, nan})
    EXPECT_THROW(bar.tear({.threshold = 1.0, .least_alignment = least}), InputError);
}

TYPED_TEST(Tearing, RefusesAStressThatIsNotFiniteAndLeavesTheBody) {
  Torn<TypeParam> bar(body_of<TypeParam>(jittered_box()));
  move(bar.body, along_z);
  bar.body.vertices.position.back().x() = std::numeric_limits<double>::quiet_NaN();
  const auto before = bar.body.map.hash();
  EXPECT_THROW(bar.tear({.threshold = 1.0}), SolverError);
  EXPECT_EQ(bar.body.map.hash(), before);
}

// Four springs around a cycle pull and push in turn along z, by more than a number holds: at each of its vertices the
// sum is infinity less infinity, in the last entry alone. The vertex that is always inspected is not among them.
TYPED_TEST(Tearing, RefusesAStressThatIsNoNumberInItsLastEntry) {
  Torn<TypeParam> pair(body_of<TypeParam>(two_tetrahedra()));
  std::vector<std::uint32_t> shared, single;  // vertices of the shared face, and the other two
  for (std::uint32_t k = 1; k < 5; ++k) {
    const auto edges = std::ranges::count_if(
        pair.arrays.edges, [k](const EdgeEntry& edge) { return edge.ends[0] == k || edge.ends[1] == k; });
    (edges == 4 ? shared : single).push_back(k);
  }
  // around two opposite vertices of one tetrahedron, or of both if vertex 0 is on the shared face
  if (single.size() == 1) single.push_back(shared.back());
  // the other entries are below the stress of vertex 0, where springs are pulled from z = 0 to 1e60 too
  for (std::uint32_t k = 1; k < 5; ++k) {
    const bool far = k == single[0] || k == single[1];
    pair.body.vertices.position[k] = {1e-200 * k, 1e-200 * k * k, far ? 1e60 : 0.0};
  }
  for (const EdgeEntry& edge : pair.arrays.edges)
    for (const bool turned : {false, true}) {
      const std::uint32_t a = edge.ends[turned ? 1 : 0], b = edge.ends[turned ? 0 : 1];
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          if (a == single[i] && b == shared[j])
            pair.body.springs.set(edge.embedding, {i == j ? 0.0 : 2e60, 1e200, 0.0});
    }
  EXPECT_THROW(pair.tear({.threshold = 1e300}), StressError);
  EXPECT_EQ(pair.followed, 0u);
}

TYPED_TEST(Tearing, OfAnEmptyBodyIsNothing) {
  Torn<TypeParam> bar(body_of<TypeParam>(Mesh{}));
  const TornVertices torn = bar.tear({.threshold = 1.0});
  EXPECT_EQ(torn.stressed + torn.tears + torn.faces, 0u);
  EXPECT_EQ(torn.largest_stress, 0.0);
}

}  // namespace
}  // namespace dartboard::tearing_test
