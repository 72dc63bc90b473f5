// Scenes that give a Young's modulus in place of a stiffness.

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "core/base/young.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"

namespace dartboard::young_scene_test {
namespace {

using namespace moving;

Json elastic(const char* generate) {
  Json scene = moving_box();
  scene["body"]["generate"] = Json::parse(generate);
  scene["material"].erase("stiffness");
  scene["material"]["young"] = 1e4;
  return scene;
}

constexpr const char* simplices[] = {R"({"box": {"cells": [2, 2, 2], "spacing": 0.125, "jitter": 0.2}})",
                                     R"({"ball": {"layers": 2, "radius": 0.25}})",
                                     R"({"sheet": {"cells": [3, 4], "spacing": 0.125}})"};
constexpr const char* a_chain = R"({"chain": {"links": 12, "spacing": 0.125}})";
constexpr const char* a_removal = R"([{"at": 0.005, "remove": {"ids": [3]}}])";

TEST(YoungsModulus, OfASceneGivesAProblemTheMeanStiffnessOfItsMesh) {
  const Problem problem = make_problem(parse(elastic(simplices[0])));
  EXPECT_EQ(problem.material.young, 1e4);
  EXPECT_EQ(problem.material.stiffness, mean_stiffness(problem.mesh, 1e4));
  EXPECT_EQ(make_problem(parse(moving_box())).material.young, 0.0);
}

TEST(YoungsModulus, MovesABodyWithTheSameBitsOnAMapAndWithout) {
  for (const char* generate : simplices) {
    const Json scene = elastic(generate);
    Simulation still(parse(scene)), on_map(parse(with_events(scene, R"([{"at": 0.01, "remove": {"ids": [3]}}])")));
    for (int n = 0; n < 9; ++n) {
      ASSERT_FALSE(still.advance());
      ASSERT_FALSE(on_map.advance());
    }
    EXPECT_EQ(still.body().map_name(), "no map");
    EXPECT_NE(on_map.body().map_name(), "no map");
    EXPECT_EQ(still.body().state_hash(), on_map.body().state_hash()) << generate;
  }
}

TEST(YoungsModulus, IsPlannedToTheByte) {
  for (const char* generate : {simplices[0], simplices[1], simplices[2], a_chain})
    for (const char* events : {"[]", a_removal}) {
      if (generate == a_chain && events == a_removal) continue;
      const SceneFile scene = parse(with_events(elastic(generate), events));
      const Problem problem = make_problem(scene);
      ScenePlan plan = plan_scene(scene);
      for (const PlanItem& item : plan.items) {
        EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, plan, item)) << generate << name(item.part);
        if (item.part == Part::springs) {
          EXPECT_NE(item.why.find("/material/young: 10000"), std::string::npos) << item.why;
        }
      }
      for (const MemoryItem& item : plan.unplanned) ADD_FAILURE() << generate << ": not planned: " << name(item.part);
    }
}

// Links in series: whatever their number, the whole is as stiff as a single link of its length.
TEST(YoungsModulus, OfAChainStretchesItAsItsLengthSays) {
  for (const int links : {1, 5, 20}) {
    Json scene = elastic(a_chain);
    scene["body"]["generate"] = {{"chain", {{"links", links}, {"spacing", 1.5 / links}}}};
    const Simulation simulation(parse(scene));
    double compliance = 0.0;
    for (const Spring spring : simulation.body().system().springs) compliance += 1.0 / spring.stiffness;
    EXPECT_NEAR(compliance, 1.5 / 1e4, 64 * 0x1p-53 * 1.5 / 1e4);
    for (const Spring spring : simulation.body().system().springs)
      EXPECT_NEAR(spring.damping, 0.25, 16 * 0x1p-53);  // all alike, so each has the mean
  }
}

TEST(YoungsModulus, SharesStiffnessAnewWhereABodyIsCutAndRefined) {
  const Json scene = elastic(simplices[0]);
  const auto sum = [](const Simulation& simulation) {
    double stiffness = 0.0;
    for (const Spring spring : simulation.body().system().springs) stiffness += spring.stiffness;
    return stiffness;
  };
  const Simulation whole(parse(scene));
  const Simulation cut(parse(
      with_events(scene, R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])")));
  EXPECT_GT(cut.body().counts().edges, whole.body().counts().edges);
  EXPECT_NEAR(sum(cut), sum(whole), 512 * 0x1p-53 * sum(whole));  // sums of some hundred springs
  Simulation refined(parse(with_events(scene, R"([{"at": 0.001, "refine": {"cells": {"ids": [0, 7, 20]}}},
                                                  {"at": 0.002, "remove": {"ids": [5]}}])")));
  run(refined);
  EXPECT_EQ(refined.body().violation(), "");
}

}  // namespace
}  // namespace dartboard::young_scene_test
