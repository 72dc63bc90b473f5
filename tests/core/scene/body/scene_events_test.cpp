#include "core/scene/body/events/ready.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/moving_box.h"

namespace dartboard::scene_events_test {
namespace {

using namespace moving;

TEST(SceneEvents, RemovesExactlyTheMassOfTheCellsRemoved) {
  Simulation simulation(parse(with_events(moving_box(), R"([{"at": 0.002, "remove": {"ids": [0, 7, 20]}}])")));
  EXPECT_EQ(simulation.body().mass(), 12.0);
  run(simulation);
  EXPECT_EQ(simulation.body().mass(), 11.25);
  EXPECT_EQ(simulation.body().removed_mass(), 0.75);
  double by_vertex = 0.0;
  for (const double m : simulation.body().vertices().mass) by_vertex += m;
  EXPECT_EQ(by_vertex, 11.25);
  EXPECT_EQ(simulation.body().violation(), "");
}

TEST(SceneEvents, SelectsCellsByTheirNumberInTheMeshWhateverTheirNumberIsNow) {
  // when cell 0 goes, the last cell takes its number
  Simulation simulation(parse(with_events(moving_box(), R"([
    {"at": 0.001, "remove": {"ids": [0]}}, {"at": 0.002, "remove": {"ids": [0]}},
    {"at": 0.003, "remove": {"ids": [47]}}])")));
  for (int n = 0; n < 2; ++n) simulation.advance();
  EXPECT_EQ(cells(simulation), 47u);
  EXPECT_EQ(simulation.frame().mesh_cell[0], 47u);
  simulation.advance();
  const auto left = simulation.frame().mesh_cell;
  EXPECT_EQ(left.size(), 46u);
  EXPECT_EQ(std::count(left.begin(), left.end(), 47u), 0);
}

TEST(SceneEvents, SelectsCellsByPlaceWhereTheyAreNow) {
  Json scene = moving_box();
  scene["gravity"] = {0, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["initial_velocity"] = {100, 0, 0};  // 0.1 m per step
  // after 5 steps the body, 0.25 m long, is between x = 0.5 and 0.75: no part of it at the old place, all of it here
  Simulation simulation(parse(with_events(scene, R"([
    {"at": 0.005, "remove": {"box": {"min": [0, 0, 0], "max": [0.25, 1, 1]}}},
    {"at": 0.006, "remove": {"box": {"min": [0.6, 0, 0], "max": [0.85, 1, 1]}}}])")));
  for (int n = 0; n < 5; ++n) simulation.advance();
  EXPECT_EQ(cells(simulation), 48u);
  simulation.advance();
  EXPECT_EQ(cells(simulation), 0u);
}

TEST(SceneEvents, CutsABodyInTwoAlongAPlane) {
  Simulation simulation(parse(with_events(
      moving_box(), R"([{"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])")));
  simulation.watch_events(true);
  run(simulation);
  const CellCounts counts = simulation.body().counts();
  EXPECT_EQ(counts.components, 2u);
  // the plane x = 0.125 holds 8 triangles, 16 edges and 9 points of the box, all of which come apart
  EXPECT_EQ(simulation.operations(), 8u);
  EXPECT_EQ(counts.vertices, 27u + 9u);
  EXPECT_EQ(counts.cells, 48u);
  EXPECT_EQ(simulation.body().mass(), 12.0);
  const auto component = simulation.frame().component;
  EXPECT_EQ(std::count(component.begin(), component.end(), 0u), 24);
  // masses are powers of two and halves of them, so that they are divided exactly
  EXPECT_EQ(simulation.jumps().events, 1u);
  EXPECT_EQ(simulation.jumps().mass, 0.0);
}

TEST(SceneEvents, DissociatesFacesByTheirPoints) {
  // points are numbered x + 3 y + 9 z; all cubes are cut along (1, 1, 1), faces of the plane x = 0.125 along (y, z)
  Simulation simulation(
      parse(with_events(moving_box(), R"([{"at": 0, "dissociate": {"points": [[1, 4, 13], [1, 10, 13]]}}])")));
  EXPECT_EQ(simulation.operations(), 2u);
  EXPECT_EQ(simulation.body().counts().faces, 120u + 2u);
}

TEST(SceneEvents, PassesOverFacesThatHaveLostACell) {
  const char* events = R"([{"at": 0, "remove": {"box": {"min": [0, 0, 0], "max": [0.125, 1, 1]}}},
                           {"at": 0, "dissociate": {"points": [[1, 4, 13]]}}])";
  const Simulation simulation(parse(with_events(moving_box(), events)));
  EXPECT_EQ(simulation.operations(), 24u);  // the removals
}

TEST(SceneEvents, PassesOverFacesWhoseCellsPlaceAnotherCellHasNow) {
  // both cubes next to two faces are removed, and their places are taken by the parts of the 36 other cells
  const char* events = R"([{"at": 0, "remove": {"box": {"min": [0, 0, 0], "max": [0.25, 0.125, 0.125]}}},
      {"at": 0, "refine": {"cells": {"sphere": {"centre": [0, 0, 0], "radius": 1}}, "at": "centre"}},
      {"at": 0, "dissociate": {"points": [[1, 4, 13], [1, 10, 13]]}}])";
  const Simulation simulation(parse(with_events(moving_box(), events)));
  EXPECT_EQ(cells(simulation), 4u * 36u);
  EXPECT_EQ(simulation.operations(), 12u + 36u);
}

TEST(SceneEvents, TearsTheLowestOfTwoVerticesThatAreAsNear) {
  Json scene =
      with_events(moving_box(), R"([{"at": 0, "tear": {"near": [0.3125, 0.25, 0.25], "direction": [1, 0, 0]}}])");
  scene["body"]["generate"]["box"]["cells"] = {4, 4, 4};
  const Simulation before(parse(with_events(scene, "[]"))), after(parse(scene));
  // points are numbered x + 5 y + 25 z, and 62 and 63 are two and three spacings along x
  const auto& old = before.body().vertices().point;
  const auto lowest = *std::find_if(old.begin(), old.end(), [](std::uint32_t p) { return p == 62 || p == 63; });
  const auto& now = after.body().vertices().point;
  ASSERT_EQ(now.size(), old.size() + 1);
  EXPECT_EQ(std::count(now.begin(), now.end(), lowest), 2);
}

TEST(SceneEvents, TearsAFanAroundAVertexInsideTheBody) {
  // around the middle of 4 x 4 x 4 cubes: the six triangles of one cube's sides there, a closed fan around the corner
  // of its six tetrahedra; the six edges between them come apart, the edges around the fan do not
  Json scene = with_events(moving_box(), R"([{"at": 0, "tear": {"vertex": 62, "direction": [1, 0, 0]}}])");
  scene["body"]["generate"]["box"]["cells"] = {4, 4, 4};
  const CellCounts before = Simulation(parse(with_events(scene, "[]"))).body().counts();
  const Simulation simulation(parse(scene));
  const CellCounts after = simulation.body().counts();
  EXPECT_EQ(simulation.operations(), 6u);
  EXPECT_EQ(after.vertices, before.vertices + 1);
  EXPECT_EQ(after.edges, before.edges + 6);
  EXPECT_EQ(after.faces, before.faces + 6);
  EXPECT_EQ(after.cells, before.cells);
  EXPECT_EQ(after.components, 1u);
  EXPECT_EQ(simulation.body().violation(), "");
}

Json stretched(double threshold) {
  Json scene = moving_box();
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = Json::parse(R"({"linear": [[100, 0, 0], [0, 0, 0], [0, 0, 0]]})");
  scene["events"] = Json::parse(R"([{"tear_where_stressed": {
      "threshold": 1, "plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["events"][0]["tear_where_stressed"]["threshold"] = threshold;
  return scene;
}

TEST(SceneEvents, TearsWhereStressedAlongItsSeamOnly) {
  // stretched by tens of per cent, far above 1 Pa: all 8 faces of the seam tear, and no others
  Simulation simulation(parse(stretched(1.0)));
  EXPECT_EQ(simulation.operations(), 0u);  // at rest nothing is stressed
  run(simulation);
  EXPECT_EQ(simulation.operations(), 8u);
  EXPECT_EQ(simulation.body().counts().components, 2u);
}

TEST(SceneEvents, DoesNotTearBelowTheThreshold) {
  Simulation simulation(parse(stretched(1e12)));
  run(simulation);
  EXPECT_EQ(simulation.operations(), 0u);
  EXPECT_GT(simulation.diagnostics().largest_stress, 1.0);
}

TEST(SceneEvents, RefinesTetrahedraAndRunsOn) {
  Simulation simulation(parse(with_events(moving_box(), R"([
      {"at": 0.001, "refine": {"cells": {"ids": [7]}, "at": "centre"}},
      {"at": 0.002, "refine": {"cells": {"sphere": {"centre": [0.125, 0.125, 0.125], "radius": 0.09}}}}])")));
  simulation.advance();
  CellCounts counts = simulation.body().counts();
  EXPECT_EQ(counts.vertices, 28u);  // one tetrahedron became four
  EXPECT_EQ(counts.cells, 51u);
  EXPECT_EQ(simulation.operations(), 1u);
  EXPECT_EQ(simulation.body().mass(), 12.0);  // quarters of powers of two
  const auto mesh_cell = simulation.frame().mesh_cell;
  EXPECT_EQ(std::count(mesh_cell.begin(), mesh_cell.end(), 7u), 4);
  run(simulation);
  counts = simulation.body().counts();
  EXPECT_GT(counts.vertices, 28u);
  EXPECT_EQ(simulation.operations(), counts.vertices - 27u);
  EXPECT_EQ(counts.components, 1u);
  EXPECT_EQ(simulation.body().mass(), 12.0);
  EXPECT_EQ(simulation.body().violation(), "");
}

TEST(SceneEvents, RunsOnWhenNothingIsLeft) {
  Simulation simulation(parse(with_events(moving_box(), R"([{"at": 0.002, "remove": {"random": {"count": 1000}}}])")));
  run(simulation);
  EXPECT_EQ(simulation.body().counts(), CellCounts{});
  EXPECT_EQ(simulation.diagnostics().mass, 0.0);
  EXPECT_EQ(simulation.diagnostics().energy(), 0.0);
  EXPECT_EQ(simulation.frame().mesh.cell_count(), 0u);
}

TEST(SceneEvents, DrawsOtherCellsForAnotherSeedAndTheSameForTheSame) {
  const Json scene = with_events(moving_box(), R"([{"at": 0, "remove": {"random": {"count": 9, "seed": 1}}}])");
  SceneFile other = parse(scene);
  reseed(other, 1);
  const auto left = [](const SceneFile& file) { return Simulation(file).frame().mesh_cell; };
  EXPECT_EQ(left(parse(scene)), left(parse(scene)));
  EXPECT_NE(left(parse(scene)), left(other));
}

}  // namespace
}  // namespace dartboard::scene_events_test
