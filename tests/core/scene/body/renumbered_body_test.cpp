// Bodies of scenes whose vertices and edges are numbered anew after changes. Bodies in contact are not: with a floor
// far below, a body does the same otherwise, and keeps its numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/base/archive.h"
#include "core/mechanics/curve_order.h"
#include "core/time/system/accelerations.h"
#include "tests/support/moving_box.h"

namespace dartboard::renumbered_body_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// 4913 vertices; a seventh of its cells is removed after two steps, and it is cut after four.
Json changing(const char* material) {
  Json scene = Json::parse(R"({
    "name": "box", "step": 0.0005, "duration": 0.004, "integrator": "rk4",
    "body": {"generate": {"box": {"cells": [16, 16, 16], "spacing": 0.125, "pattern": "kuhn"}}},
    "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [1, 1, 1]},
    "fixed": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}],
    "forces": [{"plane": {"point": [0, 0, 2], "normal": [0, 0, 1]}, "force": [0, 30, 0]}],
    "events": [{"at": 0.001, "remove": {"random": {"count": 3500, "seed": 1}}},
               {"at": 0.002, "dissociate": {"plane": {"point": [1, 1, 1], "normal": [1, 0.2, 0.1]}}}],
    "output": {"probes": [{"name": "a", "vertex": 700}, {"name": "b", "vertex": 3000}, {"name": "c", "vertex": 4912}]}})");
  scene["material"] = Json::parse(material);
  return scene;
}
Json above_a_floor(Json scene) {
  scene["contact"] = Json::parse(R"({"pressure": 2000, "depth": 0.002,
      "obstacles": [{"plane": {"point": [0, 0, -9], "normal": [0, 0, 1]}}]})");
  return scene;
}
constexpr const char* springs = R"({"density": 768, "stiffness": 64, "damping": 0.25, "viscosity": 0.5})";
constexpr const char* elements =
    R"({"density": 768, "young": 2000, "poisson": 0.3, "model": "corotational", "viscosity": 0.5})";

bool is_in_order(const SimulatedBody& body) { return std::ranges::is_sorted(body.vertices().dart); }

std::vector<std::uint32_t> by_darts(const std::vector<Dart>& dart_of) {
  std::vector<std::uint32_t> order(dart_of.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&](std::uint32_t k) { return dart_of[k]; });
  return order;
}

std::vector<Vector3d> accelerations_of(const SimulatedBody& body) {
  const SpringSystem system = body.system();
  const VertexColumns& v = body.vertices();
  std::vector<Vector3d> a(v.size());
  accelerations(system, terms_of(system), v.position, v.velocity, a);
  return a;
}

/// Both have the same cells, and states and accelerations as near as sums in two orders can be.
void expect_same(const Simulation& a, const Simulation& b) {
  const VertexColumns &u = a.body().vertices(), &v = b.body().vertices();
  const auto of_a = by_darts(u.dart), of_b = by_darts(v.dart);
  ASSERT_EQ(of_a.size(), of_b.size());
  const auto in_a = accelerations_of(a.body()), in_b = accelerations_of(b.body());
  double largest = 0.0;
  for (const Vector3d& each : in_a) largest = std::max(largest, each.norm());
  ASSERT_GT(largest, 1.0);
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const std::uint32_t i = of_a[k], j = of_b[k];
    ASSERT_EQ(u.dart[i], v.dart[j]);
    ASSERT_EQ(u.point[i], v.point[j]);
    ASSERT_EQ(u.mass[i], v.mass[j]);
    ASSERT_EQ(u.fixed[i], v.fixed[j]);
    ASSERT_EQ(u.pull[i], v.pull[j]);
    // sums of fewer than 40 forces, of the sizes of the largest, in eight steps of four stages
    ASSERT_LE((u.position[i] - v.position[j]).norm(), 1e-13);
    ASSERT_LE((u.velocity[i] - v.velocity[j]).norm(), 1e-12);
    ASSERT_LE((in_a[i] - in_b[j]).norm(), 1e-10 * largest);
  }
  const ProbeRow seen_a = a.probes(), seen_b = b.probes();
  for (std::size_t p = 0; p < seen_a.probes.size(); ++p) {
    ASSERT_EQ(seen_a.probes[p].has_value(), seen_b.probes[p].has_value());
    if (seen_a.probes[p]) {
      EXPECT_LE((seen_a.probes[p]->position - seen_b.probes[p]->position).norm(), 1e-13);
    }
  }
}

void expect_same_runs(const Json& scene, bool is_cut_enough = true) {
  Simulation ordered(parse(scene)), kept(parse(above_a_floor(scene)));
  ASSERT_GT(ordered.body().vertices().size(), near_vertices);
  for (int step = 1; step <= 8; ++step) {
    ASSERT_FALSE(ordered.advance());
    ASSERT_FALSE(kept.advance());
    EXPECT_EQ(is_in_order(ordered.body()), step < 4 || is_cut_enough) << step;
    EXPECT_EQ(is_in_order(kept.body()), step < 2) << step;
    expect_same(ordered, kept);
  }
  EXPECT_EQ(ordered.body().violation(), "");
}

TEST(RenumberedBody, OfSpringsMovesAsOneThatKeepsItsNumbers) { expect_same_runs(changing(springs)); }

TEST(RenumberedBody, OfElementsMovesAsOneThatKeepsItsNumbers) { expect_same_runs(changing(elements)); }

TEST(RenumberedBody, OfASurfaceBendsAsOneThatKeepsItsNumbers) {
  Json scene = changing(springs);
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [70, 70], "spacing": 0.03}}})");
  scene["material"] = Json::parse(R"({"density": 2, "stiffness": 64, "damping": 0.01, "viscosity": 0.5})");
  scene["bending"] = Json::parse(R"({"rigidity": 0.01})");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  scene["forces"] = Json::parse(R"([{"plane": {"point": [2.1, 0, 0], "normal": [1, 0, 0]}, "force": [0, 0, 3]}])");
  scene["events"][0]["remove"]["random"]["count"] = 1500;
  expect_same_runs(scene, false);
}

TEST(RenumberedBody, KeepsItsAttachmentsAndPressures) {
  Json scene = changing(elements);
  scene["attachments"] = Json::parse(R"([{"plane": {"point": [0, 0, 2], "normal": [0, 0, 1]}, "stiffness": 500}])");
  scene["forces"].push_back(
      Json::parse(R"({"plane": {"point": [2, 0, 0], "normal": [1, 0, 0]}, "pressure": 50, "normals": "current"})"));
  expect_same_runs(scene);
}

TEST(RenumberedBody, GoesOnFromASavedStateWithTheSameBits) {
  Json scene = changing(springs);
  // the second alone is not enough, and would be if the first were counted again
  scene["events"][1] = Json::parse(R"({"at": 0.002, "remove": {"random": {"count": 50, "seed": 2}}})");
  Simulation straight(parse(scene)), first(parse(scene)), second(parse(scene));
  for (int step = 0; step < 3; ++step) ASSERT_FALSE(first.advance());
  ASSERT_TRUE(is_in_order(first.body()));
  Archive written;
  first.save(written);
  Archive read(written.written(), "state");
  second.load(read);
  run(straight);
  run(second);
  EXPECT_FALSE(is_in_order(straight.body()));
  EXPECT_EQ(second.body().state_hash(), straight.body().state_hash());
}

}  // namespace
}  // namespace dartboard::renumbered_body_test
