#include "core/scene/survey/selection_counts.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::selection_counts_test {
namespace {

using namespace moving;
using Lines = std::vector<std::string>;

/// 11 x 2 x 2 vertices, 60 cells: with a selection of each kind.
Json bar() {
  Json json = moving_box();
  json["body"] = Json::parse(R"({"generate": {"box": {"cells": [10, 1, 1], "spacing": 0.1}}})");
  return json;
}
Lines lines(const Json& json) {
  const SceneFile scene = parse(json);
  Lines said;
  for (const SelectionCount& count : count_selections(scene, make_mesh(scene))) said.push_back(to_string(count));
  return said;
}

TEST(SelectionCounts, SayHowManyVerticesEachKeyHolds) {
  Json json = bar();
  json["fixed"] = Json::parse(R"([{"plane": {"point": [0.3, 0, 0], "normal": [-1, 0, 0]}}, {"ids": [10, 3, 3]}])");
  json["driven"] =
      Json::parse(R"([{"box": {"min": [1, 0, 0], "max": [1, 1, 0]}, "velocity": {"constant": [1, 0, 0]}}])");
  json["forces"] = Json::parse(R"([{"sphere": {"centre": [0.5, 0, 0], "radius": 0.1}, "force": [0, 0, 1]}])");
  EXPECT_EQ(lines(json), (Lines{"/fixed/0: 16 of 44 vertices", "/fixed/1: 2 of 44 vertices",
                                "/driven/0: 2 of 44 vertices", "/forces/0: 5 of 44 vertices"}));
}

TEST(SelectionCounts, SayHowManyCellsRegionsAndEventsHold) {
  Json json = bar();
  json["regions"] = Json::parse(R"([{"cells": {"box": {"min": [0, 0, 0], "max": [0.2, 1, 1]}},
                                     "material": {"density": 1, "stiffness": 1}}])");
  json["events"] = Json::parse(R"([
    {"at": 0, "remove": {"random": {"count": 7}}},
    {"at": 0, "remove": {"random": {"count": 100}}},
    {"at": 0, "refine": {"cells": {"ids": [5, 4, 5]}}}])");
  EXPECT_EQ(lines(json), (Lines{"/regions/0/cells: 12 of 60 cells", "/events/0/remove: 7 of 60 cells",
                                "/events/1/remove: 60 of 60 cells", "/events/2/refine/cells: 2 of 60 cells"}));
  json["events"] = Json::parse(R"([{"at": 0, "release": {"sphere": {"centre": [0, 0, 0], "radius": 0.1}}}])");
  EXPECT_EQ(lines(json).back(), "/events/0/release: 4 of 44 vertices");
}

TEST(SelectionCounts, OfCutsAreTheFacesThatTheBodyFindsAtRest) {
  Json json = bar();
  json["events"] = Json::parse(R"([
    {"at": 0.005, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.005, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]},
                                 "within": {"box": {"min": [0, 0, 0], "max": [1, 0.04, 1]}}}},
    {"at": 0.005, "dissociate": {"plane": {"point": [2, 0, 0], "normal": [1, 0, 0]}}}])");
  Lines said;
  const SceneSurvey survey = survey_of(parse(json));
  for (const SelectionCount& count : survey.selections) said.push_back(to_string(count));
  // inside each cube 6 faces between its six tetrahedra, between two cubes 2
  EXPECT_EQ(said, (Lines{"/events/0/dissociate: 2 of 78 faces between cells at the start",
                         "/events/1/dissociate: 1 of 78 faces between cells at the start",
                         "/events/2/dissociate: 0 of 78 faces between cells at the start; it acts where the body is "
                         "then"}));
}

// The diagonal is 1.0099..., so borders are 1.01e-9 thick.
TEST(SelectionCounts, NameALayerThatABorderMissesByLessThanTenThicknesses) {
  const auto missed = [](double x) {
    Json json = bar();
    json["fixed"] = Json::array({{{"plane", {{"point", {x, 0, 0}}, {"normal", {-1, 0, 0}}}}}});
    const SceneFile scene = parse(json);
    return count_selections(scene, make_mesh(scene)).at(0);
  };
  EXPECT_EQ(missed(0.3 - 0.9e-9).just_outside, 0u);  // on the border
  EXPECT_EQ(missed(0.3 - 0.9e-9).selected, 16u);
  EXPECT_EQ(missed(0.3 - 9e-9).just_outside, 4u);
  EXPECT_EQ(missed(0.3 - 9e-9).selected, 12u);
  EXPECT_EQ(missed(0.3 - 11e-9).just_outside, 0u);
  EXPECT_EQ(near_miss(missed(0.3 - 9e-9)),
            "/fixed/0: 4 lie just outside, less than 1e-08 m from the border, and not selected");
  EXPECT_EQ(near_miss(missed(0.3)), "");
}

/// A cut across the bar between two cubes, whose two faces have their centres at thirds of its width and height.
Json with_bounded_cut(const char* within) {
  Json json = bar();
  Json cut = Json::parse(R"({"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]}})");
  cut["within"] = Json::parse(within);
  json["events"] = Json::array({{{"at", 0.005}, {"dissociate", cut}}});
  return json;
}
SelectionCount of_cut(const Json& json) { return survey_of(parse(json)).selections.back(); }

// Within the box there are also the faces inside of cubes, with centres nearer to its border than the two of the cut.
TEST(SelectionCounts, NameTheFacesOfACutThatItsBoundsMissByLessThanTenThicknesses) {
  const auto missed = [](const char* least) {
    return of_cut(
        with_bounded_cut((R"({"box": {"min": [0, )" + std::string(least) + R"(, 0], "max": [1, 1, 1]}})").c_str()));
  };
  // two thirds of 0.1 m, and more by some 0.7, 7 and 13 thicknesses
  for (const auto& [least, selected, just_outside] :
       {std::tuple{"0.0666666674", 1u, 0u}, {"0.0666666740", 0u, 1u}, {"0.0666666800", 0u, 0u}}) {
    EXPECT_EQ(missed(least).selected, selected) << least;
    EXPECT_EQ(missed(least).just_outside, just_outside) << least;
  }
  EXPECT_EQ(near_miss(missed("0.0666666740")),
            "/events/0/dissociate: 1 lies just outside, less than 1e-08 m from the border, and not selected");
}

TEST(SelectionCounts, NameTheFacesThatBoundsOfEveryShapeMiss) {
  // the centre of a face at two thirds of the width is a sixtieth of a metre above or below that of the sphere
  for (const char* within :
       {R"({"sphere": {"centre": [0.5, 0.16666666666667, 0.05], "radius": 0.101379368505}})",
        R"({"polygon": [[0.5, 0.0666666740, 0], [0.5, 0.2, 0], [0.5, 0.2, 0.2], [0.5, 0.0666666740, 0.2]]})"})
    EXPECT_EQ(of_cut(with_bounded_cut(within)).just_outside, 1u) << within;
}

TEST(SelectionCounts, OfCutsAreThoseOfThePlanAndTheRunAlike) {
  const Json json = with_bounded_cut(R"({"box": {"min": [0, 0.0666666740, 0], "max": [1, 1, 1]}})");
  const SceneFile scene = parse(json);
  const SelectionCount planned = plan_scene(scene).selections.back(), run = of_cut(json);
  EXPECT_EQ(to_string(planned), to_string(run));
  EXPECT_EQ(near_miss(planned), near_miss(run));
  EXPECT_EQ(planned.just_outside, 1u);
}

TEST(SelectionCounts, OfACutOfASurfaceNameItsEdges) {
  Json json = bar();
  json["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [2, 2], "spacing": 0.5}}})");
  json["events"] = Json::parse(R"([{"at": 0.005, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0, 0]},
                                   "within": {"box": {"min": [0, 0.250000005, -1], "max": [1, 0.7, 1]}}}}])");
  const SelectionCount count = of_cut(json);
  EXPECT_EQ(to_string(count),
            "/events/0/dissociate: 0 of 8 edges between faces at the start; it acts where the body is then");
  EXPECT_EQ(count.just_outside, 1u);
}

}  // namespace
}  // namespace dartboard::selection_counts_test
