// Vertices and edges numbered anew after changes.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "core/mechanics/curve_order.h"
#include "core/mechanics/numbering.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/operations/remove_volume.h"
#include "core/plain/random.h"
#include "tests/support/body_expectations.h"

namespace dartboard::renumber_test {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

template <class Map>
Body<Map> box(int n) {
  Problem problem;
  problem.mesh = kuhn_box(n, n, n, 0.125, 0.2, 3);
  problem.material = {.density = 1000.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  for (const auto& p : problem.mesh.points) problem.initial_velocity.push_back(p.cwiseProduct(p));
  for (std::uint32_t p = 0; p < problem.mesh.points.size(); p += 3) problem.fixed.push_back(p);
  for (std::uint32_t p = 1; p < problem.mesh.points.size(); p += 3) problem.held_axes.push_back({p, 2});
  auto body = build_body<Map, Held::by_every_dart>(problem);
  body.vertices.keep_rest();
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
    body.vertices.pull.push_back(Eigen::Vector3d(k, 2.0 * k, -1.0 * k));
  return body;
}

/// Cells drawn at random are removed, and faces dissociated.
template <class Map>
ChangedEmbeddings change(Body<Map>& body, std::size_t cells, std::size_t faces, std::uint64_t seed) {
  SplitMix64 random(seed);
  TopologyChange change;
  std::vector<Dart> left = body.cell_dart;
  for (std::size_t k = 0; k < cells; ++k) {
    const std::size_t c = random.below(left.size());
    change.append(remove_volume(body.map, left[c]));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(c));
  }
  std::vector<Dart> seam;
  for (std::size_t k = 0; k < faces; ++k) seam.push_back(left[random.below(left.size())]);
  change.append(dissociate_all(body.map, seam));
  return adapt(body, change);
}

template <class Map>
struct Renumber : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Renumber, Solids);

TYPED_TEST(Renumber, OrdersVerticesAndEdgesByTheirDarts) {
  auto body = box<TypeParam>(3);
  change(body, 60, 40, 1);
  ASSERT_FALSE(std::ranges::is_sorted(body.vertices.dart));
  ASSERT_FALSE(std::ranges::is_sorted(body.edge_dart));
  renumber(body);
  EXPECT_TRUE(std::ranges::is_sorted(body.vertices.dart));
  EXPECT_TRUE(std::ranges::is_sorted(body.edge_dart));
  CellArrays arrays;
  arrays.rebuild(body);
  expect_consistent(body, arrays);
}

TYPED_TEST(Renumber, LeavesABodyAsItWasBuilt) {
  auto body = box<TypeParam>(2);
  const auto darts = body.vertices.dart;
  const auto number = renumber(body);
  for (std::uint32_t k = 0; k < number.size(); ++k) EXPECT_EQ(number[k], k);
  EXPECT_EQ(body.vertices.dart, darts);
}

TYPED_TEST(Renumber, MovesAllThatAVertexAndAnEdgeCarry) {
  auto body = box<TypeParam>(3);
  change(body, 60, 40, 2);
  for (std::uint32_t k = 0; k < body.springs.size(); ++k) body.springs.change(k, [k](Spring& s) { s.rest_length = k; });
  const auto before = body;
  const auto number = renumber(body);
  ASSERT_EQ(number.size(), before.vertices.size());
  std::size_t columns = 0;
  std::apply(
      [&](const auto&... row) {
        const auto compare = [&](const auto& old, const auto& now) {
          ASSERT_EQ(now.size(), old.size());
          for (std::uint32_t k = 0; k < old.size(); ++k) ASSERT_EQ(now[number[k]], old[k]);
          ++columns;
        };
        (compare(before.vertices.*(row.values), body.vertices.*(row.values)), ...);
      },
      VertexColumns::embedded());
  EXPECT_EQ(columns, 11u);
  for (std::uint32_t k = 0; k < number.size(); ++k) EXPECT_EQ(body.vertices.dart[number[k]], before.vertices.dart[k]);
  body.map.for_each_dart([&](Dart d) {
    const Spring now = body.springs[body.edge(body.map, d)], old = before.springs[before.edge(before.map, d)];
    EXPECT_EQ(now.rest_length, old.rest_length);
    EXPECT_EQ(now.stiffness, old.stiffness);
    EXPECT_EQ(now.damping, old.damping);
  });
}

TYPED_TEST(Renumber, IsFollowedByChangesAsBefore) {
  auto body = box<TypeParam>(3);
  CellArrays arrays;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    change(body, 15, 20, seed);
    renumber(body);
    arrays.rebuild(body);
    arrays.apply(body, change(body, 15, 20, 10 + seed));
    expect_consistent(body, arrays);
  }
}

// ---- when

constexpr int large = 17;  // 18^3 vertices, more than near_vertices

/// The share of springs that are not in the order of the darts, or have a vertex that is not, if all were in order
/// before and none had two such vertices.
double scattered_by(const ChangedEmbeddings& changed, std::size_t vertices, std::size_t edges) {
  const auto share = [](std::size_t now, std::size_t before, std::size_t moved) {
    return static_cast<double>(now + moved - before + moved) / static_cast<double>(now);
  };
  return 2.0 * share(changed.vertex_count, vertices, changed.moved_vertices.size()) +
         share(changed.edge_count, edges, changed.moved_edges.size());
}

/// The next cells along the body are removed: their vertices and edges are gone, and the last ones fill the gaps.
ChangedEmbeddings remove_next(Body<TetMap>& body, std::size_t cells) {
  std::vector<Dart> darts = body.cell_dart;
  std::ranges::sort(darts);
  TopologyChange change;
  for (std::size_t k = 0; k < cells; ++k) change.append(remove_volume(body.map, darts[k]));
  return adapt(body, change);
}

TEST(NumberingOfChanges, IsMadeAnewOnceEnoughIsScattered) {
  const std::function<ChangedEmbeddings(Body<TetMap>&, std::uint64_t)> kinds[]{
      [](auto& body, std::uint64_t seed) { return change(body, 0, 40, seed); },
      [](auto& body, std::uint64_t seed) { return change(body, 40, 0, seed); },
      [](auto& body, std::uint64_t) { return remove_next(body, 40); }};
  for (const auto& change_by : kinds) {
    auto body = box<TetMap>(large);
    ASSERT_GT(body.vertices.size(), near_vertices);
    Numbering numbering(body);
    double scattered = 0.0;
    std::uint64_t round = 0;
    for (int made = 0; made < 2 && body.vertices.size() > near_vertices; ++round) {
      const std::size_t vertices = body.vertices.size(), edges = body.springs.size();
      const ChangedEmbeddings changed = change_by(body, round);
      scattered += scattered_by(changed, vertices, edges);
      const bool anew = !numbering.follow(body, changed).empty();
      // earlier changes are shares of other totals, which differ by less than a tenth
      ASSERT_TRUE(anew ? scattered > 0.9 / 16.0 : scattered < 1.1 / 16.0) << scattered;
      EXPECT_EQ(anew, std::ranges::is_sorted(body.vertices.dart) && std::ranges::is_sorted(body.edge_dart));
      if (anew) scattered = 0.0;
      made += anew;
    }
    EXPECT_GT(round, 10u);
  }
}

TEST(NumberingOfChanges, StaysInABodyOfFewVertices) {
  auto body = box<TetMap>(8);
  Numbering numbering(body);
  EXPECT_TRUE(numbering.follow(body, change(body, 1000, 100, 1)).empty());
}

}  // namespace
}  // namespace dartboard::renumber_test
