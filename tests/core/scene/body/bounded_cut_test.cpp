// A cut along a plane that ends inside the body.

#include <gtest/gtest.h>

#include <string>

#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "tests/support/moving_box.h"

namespace dartboard::bounded_cut_test {
namespace {

using namespace moving;

// The plane x = 0.125 of the box holds 8 triangles, two for each of the four squares of 0.125 m next to (y, z).
Json cut(const char* within) {
  return with_events(moving_box(),
                     (std::string(R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]},
                                                    "within": )") +
                      within + "}}]")
                         .c_str());
}

const char* const lower_half = R"({"box": {"min": [0, 0, 0], "max": [0.25, 0.125, 0.25]}})";

TEST(BoundedCut, DissociatesTheFacesWhoseCentreIsInTheRegion) {
  const Simulation half(parse(cut(lower_half)));
  EXPECT_EQ(half.operations(), 4u);
  EXPECT_EQ(half.body().counts().components, 1u);
  EXPECT_EQ(half.body().violation(), "");
  EXPECT_EQ(Simulation(parse(cut(R"({"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}})"))).operations(), 8u);
  EXPECT_EQ(Simulation(parse(cut(R"({"sphere": {"centre": [0.125, 0.0625, 0.0625], "radius": 0.05}})"))).operations(),
            2u);
}

// An L of three of the four squares; its corners run one way or the other.
TEST(BoundedCut, DissociatesTheFacesInAPolygonThatNeedNotBeConvex) {
  const char* const one_way = R"({"polygon": [[0.125, 0, 0], [0.125, 0.25, 0], [0.125, 0.25, 0.125],
                                              [0.125, 0.125, 0.125], [0.125, 0.125, 0.25], [0.125, 0, 0.25]]})";
  const char* const other_way = R"({"polygon": [[5, 0, 0.25], [5, 0.125, 0.25], [5, 0.125, 0.125],
                                                [5, 0.25, 0.125], [5, 0.25, 0], [5, 0, 0]]})";  // seen along x
  const Simulation one(parse(cut(one_way))), other(parse(cut(other_way)));
  EXPECT_EQ(one.operations(), 6u);
  EXPECT_EQ(one.body().state_hash(), other.body().state_hash());
  EXPECT_EQ(one.body().counts(), other.body().counts());
  EXPECT_EQ(one.body().counts().components, 1u);
}

// Four triangles in two squares side by side: three of their points on the border of the cut, at y = 0, come apart, and
// the edges between them and inwards; those at y = 0.125 are the tip, where one turn around the edge is left.
TEST(BoundedCut, LeavesTheTipTogether) {
  const Simulation whole(parse(moving_box())), half(parse(cut(lower_half)));
  EXPECT_EQ(half.body().counts().vertices, whole.body().counts().vertices + 3);
  EXPECT_EQ(half.body().counts().faces, whole.body().counts().faces + 4);
  EXPECT_EQ(half.body().counts().edges, whole.body().counts().edges + 7);
}

TEST(BoundedCut, FollowsTheBodyToWhereItIs) {
  Json json = cut(lower_half);
  json["events"][0]["at"] = 0.01;
  json["initial_velocity"] = {0, 100, 0};  // 1 m along y until then
  Simulation simulation(parse(json));
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
  EXPECT_EQ(simulation.operations(), 0u);
}

TEST(BoundedCut, IsForeseenAsItWillBe) { EXPECT_EQ(plan_scene(parse(cut(lower_half))).events.at(0).operations, 4.0); }

TEST(BoundedCut, OfFacesGivenByTheirPointsIsRefused) {
  Json json = cut(lower_half);
  json["events"][0]["dissociate"].erase("plane");
  json["events"][0]["dissociate"]["points"] = Json::parse("[[1, 4, 13]]");
  EXPECT_THROW(parse(json), InputError);
}

TEST(BoundedCut, InASurfaceReachesItsEdges) {
  Json json = moving_box();
  json["body"] =
      Json::parse(R"({"generate": {"sheet": {"cells": [4, 4], "spacing": 0.25, "kind": "quadrilaterals"}}})");
  json["events"] = Json::parse(R"([{"at": 0, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]},
                                    "within": {"box": {"min": [0, 0, -1], "max": [1, 0.5, 1]}}}}])");
  EXPECT_EQ(Simulation(parse(json)).operations(), 2u);
}

}  // namespace
}  // namespace dartboard::bounded_cut_test
