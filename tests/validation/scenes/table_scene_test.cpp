// Scenes made by programs: the networks that they pass to the references, and what they start from.

#include "validation/scenes/table_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard::table_scene_test {
namespace {

TableScene box() {
  TableScene scene{.name = "box", .problem = {}, .checkpoints = 4};
  scene.problem.mesh = kuhn_box(2, 2, 2, 0.5, 0.2, 1);
  scene.problem.surroundings.gravity = {0, 0.25, -0.5};  // the default pulls these springs flat
  scene.problem.fixed = {0};
  scene.initial_position = scene.problem.mesh.points;
  scene.problem.initial_velocity.assign(scene.initial_position.size(), {0, 0, 0});
  return scene;
}
constexpr std::uint32_t inner = 13;  // the one point within the box

using Springs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>>;
void add(Springs& sums, std::uint32_t a, std::uint32_t b, double stiffness, double damping) {
  auto& [k, c] = sums[std::minmax(a, b)];
  k += stiffness;
  c += damping;
}
// The sum of the parallel springs, by their ends.
Springs of_body(const SpringSystem& system) {
  Springs sums;
  for (std::size_t e = 0; e < system.springs.size(); ++e)
    add(sums, system.ends[e][0], system.ends[e][1], system.springs[e].stiffness, system.springs[e].damping);
  return sums;
}
Springs of_network(const reference::SpringNetwork& network) {
  Springs sums;
  for (const reference::Spring& s : network.springs) add(sums, s.a, s.b, s.stiffness, s.damping);
  return sums;
}

TEST(TableScene, HandsTheReferencesTheMassesAndSpringsThatTheBodyHas) {
  TableScene table = box();
  table.problem.material.damping = 0.0;
  add_cut(table, 0.25, {0.5, 0.5, 0.5}, {1, 0, 0});
  table.events.push_back({Tear{inner, Eigen::Vector3d(0, 0, 1)}, 0.5, 0.5, {}, "/events/1"});
  const TradeoffScene scene = tradeoff_scene({}, table);
  ASSERT_EQ(scene.motion.events.size(), 2u);
  FrozenBody body(*scene.frozen);
  for (std::size_t interval = 0; interval <= 2; ++interval) {
    if (interval > 0) body.pass();
    const reference::SpringNetwork& network = scene.motion.network_of(interval);
    const VertexColumns& vertices = body.body().vertices();
    ASSERT_EQ(network.point_count(), vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      // up to 24 shares are added in another order
      EXPECT_NEAR(network.mass[k], vertices.mass[k], 24 * 0x1p-53 * vertices.mass[k]);
      EXPECT_EQ(network.fixed[k], vertices.fixed[k]);
    }
    EXPECT_EQ(of_body(body.body().system()), of_network(network));  // whole multiples of 50
  }
  EXPECT_GT(scene.motion.events[0].network.point_count(), scene.motion.network.point_count());
  EXPECT_GT(scene.motion.events[1].network.point_count(), scene.motion.events[0].network.point_count());
}

TEST(TableScene, IsCutOnceInTwoAlongAPlaneOfTheBodyAtRest) {
  TableScene table = box();
  for (auto& x : table.initial_position) x += Eigen::Vector3d(10, 0, 0);
  add_cut(table, 0.25, {0.5, 0.5, 0.5}, {1, 0, 0});
  const TradeoffScene scene = tradeoff_scene({}, table);
  ASSERT_EQ(scene.motion.events.size(), 1u);
  // each point of the middle layer, 3 x 3 of them, is of both halves
  EXPECT_EQ(scene.motion.events[0].network.point_count(), scene.motion.network.point_count() + 9);
}

TEST(TableScene, StartsFromItsInitialPositionsWithTheSpringsOfTheMesh) {
  TableScene table = box();
  table.initial_position[5][0] += 0.25;
  table.problem.initial_velocity[6] = {0, 1, 0};
  const TradeoffScene scene = tradeoff_scene({}, table);
  FrozenBody body(*scene.frozen);
  for (std::size_t k = 0; k < scene.motion.start.x.size(); ++k) {
    const std::uint32_t point = body.body().vertices().point[k];
    EXPECT_EQ(scene.motion.start.x[k], table.initial_position[point]);
    EXPECT_EQ(scene.motion.start.v[k], table.problem.initial_velocity[point]);
    EXPECT_EQ(body.body().vertices().position[k], table.initial_position[point]);
  }
  table.initial_position.clear();
  const TradeoffScene at_rest = tradeoff_scene({}, table);
  for (std::size_t k = 0; k < at_rest.motion.start.x.size(); ++k)
    EXPECT_EQ(at_rest.motion.start.x[k], table.problem.mesh.points[body.body().vertices().point[k]]);
  for (std::size_t e = 0; e < scene.motion.network.springs.size(); ++e)
    EXPECT_EQ(scene.motion.network.springs[e].rest_length, at_rest.motion.network.springs[e].rest_length);
}

TEST(TableScene, NeedsAnInitialPositionForEachPoint) {
  TableScene table = box();
  table.initial_position.pop_back();
  EXPECT_THROW(tradeoff_scene({}, table), InputError);
}

TEST(Inclusion, StiffensAndDampsTheNearestTenthOfTheCellsAlikeInBodyAndNetwork) {
  TableScene table = box();
  const double before = tradeoff_scene({}, table).fastest_rate;
  for (auto& x : table.initial_position) x *= 1.5;
  add_inclusion(table, {0, 0, 0}, 1e4);
  EXPECT_EQ(std::ranges::count(table.problem.cell_material, 1), 4);  // of 48
  EXPECT_EQ(table.initial_position[0], table.problem.mesh.points[0]);
  EXPECT_EQ(table.initial_position.back(), 1.5 * table.problem.mesh.points.back());
  set_damping(table.problem, 0x1p-6);
  const TradeoffScene scene = tradeoff_scene({}, table);
  EXPECT_GT(scene.fastest_rate, 10.0 * before);
  FrozenBody body(*scene.frozen);
  const Springs springs = of_body(body.body().system());
  // whole multiples below 2^53 of the softer ones: exact in any order
  EXPECT_EQ(springs, of_network(scene.motion.network));
  for (const auto& [ends, spring] : springs) EXPECT_EQ(spring.second, 0x1p-6 * spring.first);
}

}  // namespace
}  // namespace dartboard::table_scene_test
