#include "validation/drawn/relations/relations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/validation/drawn/covering_scenes.h"
#include "validation/drawn/changed_scene.h"
#include "validation/drawn/drawn_scene.h"
#include "validation/drawn/relations/drawn_trial.h"
#include "validation/drawn/written_meshes.h"

namespace dartboard::relations_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t judged_by_all = 220;  // of the covering scenes
constexpr int shards = 20;

/// A part of the scenes, so that parts run side by side.
struct DrawnRelations : FolderTest, testing::WithParamInterface<int> {
  void expect_hold(std::uint64_t number, const std::vector<std::string_view>& only = {}) {
    const JudgedScene scene(drawn_scene(1, number), "", folder_);
    for (const Relation& relation : relations()) {
      if (!only.empty() && std::ranges::find(only, relation.name) == only.end()) continue;
      const RelationFound found = try_relation(scene, relation);
      EXPECT_NE(found.outcome, RelationOutcome::breaks)
          << "dartboard validate drawn --seed 1 --first " << number << " --count 1 --relation " << relation.name << ": "
          << found.words;
    }
  }
};

TEST_P(DrawnRelations, Hold) {
  for (std::size_t k = static_cast<std::size_t>(GetParam()); k < judged_by_all; k += shards)
    expect_hold(covering_scenes[k]);
}

// Where pairs of keys are rare, relations that cost one run of the scene, or none.
TEST_P(DrawnRelations, OfStoppedRunsAndTurnedAxesHoldForRarePairs) {
  for (std::size_t k = judged_by_all + static_cast<std::size_t>(GetParam()); k < covering_scenes.size(); k += shards)
    expect_hold(covering_scenes[k], {"continued", "axes", "held", "losses", "obstacles", "strains"});
}

INSTANTIATE_TEST_SUITE_P(Of, DrawnRelations, testing::Range(0, shards));

/// A sheet that falls on a floor and is cut.
Json falling_sheet() {
  return Json::parse(R"({"name": "sheet", "body": {"generate": {"sheet": {"cells": [3, 2], "spacing": 0.1}}},
    "material": {"density": 1, "stiffness": 100, "damping": 0, "viscosity": 0}, "step": 0.001, "duration": 0.03,
    "integrator": "rk4", "initial_velocity": [0.1, 0, -1],
    "contact": {"pressure": 100, "depth": 0.01, "obstacles": [{"plane": {"point": [0, 0, -0.005], "normal": [0, 0, 1]}}]},
    "events": [{"at": 0.012, "dissociate": {"plane": {"point": [0.17, 0, 0], "normal": [1, 0.1, 0]}}}]})");
}

std::set<std::string> outcomes_of(const Json& scene, RelationOutcome outcome) {
  std::set<std::string> names;
  for (const RelationTrial& trial : try_relations(scene, "", ""))
    if (trial.found.outcome == outcome) names.insert(std::string(trial.relation->name));
  return names;
}

TEST(Relations, ApplyWhereTheyHaveAMeaning) {
  EXPECT_EQ(outcomes_of(falling_sheet(), RelationOutcome::breaks), std::set<std::string>{});
  EXPECT_EQ(outcomes_of(falling_sheet(), RelationOutcome::does_not_apply),
            (std::set<std::string>{"energy", "files", "frames", "held", "limit", "losses", "mesh-files", "mirror",
                                   "momentum", "moving-frame", "numbers", "opposite-order", "pieces"}));
  Json free = falling_sheet();
  free.erase("contact");
  free.erase("events");
  free["integrator"] = "verlet";
  EXPECT_EQ(outcomes_of(free, RelationOutcome::does_not_apply),
            (std::set<std::string>{"event-times", "files", "frames", "held", "losses", "mesh-files", "mirror",
                                   "numbers", "obstacles", "opposite-order", "pieces", "resting-obstacles"}));
}

TEST(Relations, AreFoundByName) {
  EXPECT_EQ(find_relation("units").name, "units");
  EXPECT_THROW((void)find_relation("unity"), InputError);
}

TEST(Relations, RefuseASceneWithoutAStep) {
  Json scene = falling_sheet();
  scene.erase("step");
  scene["accuracy"] = 0.01;
  EXPECT_THROW((void)try_relations(scene, "", ""), InputError);
}

// ---- what a wrong program would do: the scene changes where only its form should

DrawnMotion motion_of(const Json& scene) { return run_drawn(scene, ""); }

TEST(Relations, SeeOneDigitOfOneNumber) {
  Json other = falling_sheet();
  other["initial_velocity"][0] = 0.1 + 0x1p-56;
  const auto difference = different_bits(motion_of(falling_sheet()), motion_of(other));
  ASSERT_TRUE(difference);
  EXPECT_NE(difference->find("positions at step 10: "), std::string::npos) << *difference;
}

TEST(Relations, SeeALengthThatIsNotChangedWithItsUnit) {
  const Dimensions powers{2, -2, 4};
  Json other = in_units(falling_sheet(), powers, 2);
  EXPECT_FALSE(different_bits(in_units(motion_of(falling_sheet()), powers), motion_of(other)));
  other["contact"]["depth"] = 0.01;
  EXPECT_TRUE(different_bits(in_units(motion_of(falling_sheet()), powers), motion_of(other)));
}

TEST(Relations, SeeAnAxisThatIsNotTurned) {
  const DrawnMotion expected = in_turned_axes(motion_of(falling_sheet()));
  const MotionScales scales{.length = 0.3, .time = 0.001, .mass = 0.06};
  Json other = in_turned_axes(falling_sheet());
  const auto allowed =
      allowances(motion_of(falling_sheet()), motion_of(with_disturbance(falling_sheet(), 0x1p-34, 0.3)), scales);
  ASSERT_TRUE(allowed);
  EXPECT_FALSE(differs_by_more(expected, motion_of(other), *allowed));
  other["gravity"] = {0, 0, -9.81};
  EXPECT_TRUE(differs_by_more(expected, motion_of(other), *allowed));
}

TEST(Relations, SeeABodyThatDoesNotMoveWithTheFrame) {
  Json scene = falling_sheet();
  scene.erase("contact");
  scene.erase("events");
  const Eigen::Vector3d place(1, 2, 3), velocity(4, 5, 6);
  const DrawnMotion own = first_of(motion_of(scene), motion_of(scene));
  const auto allowed = allowances(own, first_of(motion_of(with_disturbance(scene, 0x1p-34, 0.3)), own),
                                  {.length = 0.3, .time = 0.001, .mass = 0.06});
  ASSERT_TRUE(allowed);
  const auto found = [&](const Json& moving) {
    return first_of(out_of_moving_frame(motion_of(moving), place, velocity), own);
  };
  Json moving = in_moving_frame(scene, place, velocity);
  EXPECT_FALSE(differs_by_more(own, found(moving), *allowed));
  moving["initial_velocity"][1] = 5.1;
  EXPECT_TRUE(differs_by_more(own, found(moving), *allowed));
}

TEST(Relations, CompareBodiesInTheOppositeOrderVertexByVertex) {
  Json scene = falling_sheet();
  for (const char* key : {"body", "contact", "events"}) scene.erase(key);
  scene["bodies"] = Json::parse(R"([{"generate": {"sheet": {"cells": [1, 1], "spacing": 0.1}}},
      {"generate": {"sheet": {"cells": [2, 1], "spacing": 0.2}}, "translate": [0, 0, 1]}])");
  const DrawnMotion own = first_of(motion_of(scene), motion_of(scene)), other = motion_of(with_opposite_order(scene));
  const std::vector<std::size_t> number{4, 5, 6, 7, 8, 9, 0, 1, 2, 3};
  EXPECT_FALSE(different_bits(own, first_of(in_order_of(other, number), own)));
  EXPECT_TRUE(different_bits(own, first_of(other, own)));
}

TEST(Relations, LeaveOpenWhatRoundingDecides) {
  const DrawnMotion one = motion_of(falling_sheet());
  Json other = falling_sheet();
  other.erase("events");
  EXPECT_FALSE(allowances(one, motion_of(other), {.length = 0.3, .time = 0.001, .mass = 0.06}));
}

/// Breaks where the body is exactly at its place.
RelationFound breaks_in_place(const JudgedScene& scene) {
  return scene.json()["body"].contains("translate") ? RelationFound{} : RelationFound{RelationOutcome::breaks, "there"};
}

TEST(Relations, OfRoundingDoNotBreakWhereTheyHoldNearby) {
  const JudgedScene scene(falling_sheet(), "", "");
  const Relation of_rounding{"x", "", "rounding; or more", breaks_in_place},
      of_bits{"x", "", "same bits", breaks_in_place};
  EXPECT_EQ(try_relation(scene, of_rounding).outcome, RelationOutcome::does_not_apply);
  EXPECT_EQ(try_relation(scene, of_bits).outcome, RelationOutcome::breaks);
}

TEST(Relations, CompareWithAnotherBodyOnlyWhatBothHave) {
  const Json scene = falling_sheet();
  const auto with = with_body_far_away(scene, 0.3, 0.06, 2);
  ASSERT_TRUE(with);
  const DrawnMotion found = motion_of(with->json), expected = first_of(motion_of(scene), found);
  ASSERT_FALSE(expected.quantities.empty());
  EXPECT_EQ(first_of(found, expected).quantities.size(), expected.quantities.size());
  EXPECT_EQ(expected.quantities[0].values.size(), motion_of(scene).quantities[0].values.size());
}

struct WrittenMeshes : FolderTest {};

TEST_F(WrittenMeshes, HaveTheNumbersOfTheirPoints) {
  Json scene = falling_sheet();
  scene.erase("events");
  const JudgedScene judged(scene, "", "");
  const WrittenScene other = with_written_meshes(scene, judged.file(), folder_, MeshChange::renumbered);
  EXPECT_FALSE(std::ranges::is_sorted(other.number));
  const DrawnMotion own = by_vertex(judged.motion()), found = by_vertex(motion_of(other.json));
  const DrawnMotion in_order = in_order_of(found, other.number);
  EXPECT_EQ(last_named(in_order, "masses").values, last_named(own, "masses").values);
  EXPECT_NE(last_named(found, "positions").values, last_named(in_order, "positions").values);
}

TEST_F(WrittenMeshes, InAMirrorMoveAsTheSceneThatIsMirroredToo) {
  const JudgedScene judged(falling_sheet(), "", "");
  const WrittenScene other = with_written_meshes(falling_sheet(), judged.file(), folder_, MeshChange::mirrored);
  const auto x = [](const DrawnMotion& motion) { return last_named(motion, "positions").values[0]; };
  EXPECT_NEAR(x(in_mirror(motion_of(in_mirror(other.json)))), x(judged.motion()), 1e-12);
  Json half = in_mirror(other.json);
  half["initial_velocity"] = falling_sheet()["initial_velocity"];
  EXPECT_GT(std::abs(x(in_mirror(motion_of(half))) - x(judged.motion())), 1e-3);
}

TEST(Relations, LeaveOutVerticesThatCameApart) {
  const DrawnMotion all = motion_of(falling_sheet()), single = by_vertex(all);
  const std::size_t cut = last_named(all, "masses").values.size();
  EXPECT_EQ(first_named(single, "masses").values.size(), 12u);
  EXPECT_GT(cut, 12u);
  // two of each that came apart
  EXPECT_EQ(last_named(single, "masses").values.size(), 12 - (cut - 12));
}

TEST(InPieces, DivideWhatActsThen) {
  Json scene = falling_sheet();
  scene["forces"] = Json::parse(R"([{"ids": [0], "force": [1, 0, 0], "until": 0.01},
    {"ids": [1], "force": [1, 0, 0], "over_time": [{"at": 0, "factor": 1}, {"at": 0.02, "factor": 3}]}])");
  const auto pieces = in_pieces(scene, 0.005);
  ASSERT_TRUE(pieces);
  EXPECT_EQ((*pieces)["forces"], Json::parse(R"([{"ids": [0], "force": [1, 0, 0], "until": 0.005},
    {"ids": [1], "force": [1, 0, 0], "over_time": [{"at": 0, "factor": 1}, {"at": 0.005, "factor": 1.5},
                                                    {"at": 0.02, "factor": 3}], "until": 0.005},
    {"ids": [1], "force": [1, 0, 0], "over_time": [{"at": 0, "factor": 1}, {"at": 0.005, "factor": 1.5},
                                                    {"at": 0.02, "factor": 3}], "from": 0.005},
    {"ids": [0], "force": [1, 0, 0], "until": 0.01, "from": 0.005}])"));
  scene["forces"].erase(1);
  EXPECT_FALSE(in_pieces(scene, 0.02));
}

TEST(Relations, GoOnFromAStateThatIsRead) {
  EXPECT_FALSE(different_bits(motion_of(falling_sheet()), run_drawn(falling_sheet(), "", {.continued = true})));
}

TEST(FirstSteps, LeaveOutWhatBeginsLaterAndHoldWhatIsDrivenLater) {
  Json scene = falling_sheet();
  scene["driven"] = Json::array({{{"ids", {0}}, {"velocity", {1, 0, 0}}, {"from", 0.02}}});
  scene["forces"] = Json::array({{{"ids", {1}}, {"force", {1, 0, 0}}, {"from", 0.02}}});
  scene["contact"]["obstacles"][0].update({{"velocity", {0, 0, 1}}, {"from", 0.02}});
  const Json first = first_steps(scene, 10);
  EXPECT_EQ(first["duration"], 0.01);
  EXPECT_EQ(first["fixed"], Json::array({{{"ids", {0}}}}));
  for (const char* key : {"driven", "forces", "events"}) EXPECT_TRUE(first[key].empty()) << key;
  EXPECT_FALSE(first["contact"]["obstacles"][0].contains("velocity"));
  EXPECT_EQ(first_steps(scene, 100), scene);
}

TEST(SmallestBreaking, KeepsWhatTheFaultNeeds) {
  // gravity is what a scene has that is not turned
  static constexpr Relation wrong{"wrong", "", "", [](const JudgedScene& s) {
                                    const bool falls = s.json().contains("gravity") && s.json()["gravity"][1] != 0.0;
                                    return RelationFound{falls ? RelationOutcome::breaks : RelationOutcome::holds, ""};
                                  }};
  Json scene = falling_sheet();
  scene["gravity"] = {0.3, 2.5, -9.81};
  const Json smallest = smallest_breaking(scene, wrong, "", "");
  EXPECT_EQ(smallest,
            Json::parse(R"({"name": "sheet", "body": {"generate": {"sheet": {"cells": [1, 1], "spacing": 0.1}}},
                                      "step": 0.001, "duration": 0.0, "gravity": [0.0, 2.0, 0.0]})"))
      << smallest.dump();
}

}  // namespace
}  // namespace dartboard::relations_test
