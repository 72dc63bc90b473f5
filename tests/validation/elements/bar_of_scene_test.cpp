#include "validation/elements/bar_of_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/plain/error.h"

namespace dartboard::bar_of_scene_test {
namespace {

struct Parts {
  std::string body =
      R"({"generate": {"box": {"cells": [4, 4, 24], "spacing": 0.01, "pattern": "kuhn"}}, "translate": [1, 2, 3]})";
  std::string material = R"({"density": 1100, "young": 2e5, "poisson": 0.3, "viscosity": 0})";
  std::string fixed = R"([{"plane": {"point": [0, 0, 3.2399], "normal": [0, 0, 1]}}])";
  std::string more{};
};
SceneFile scene(const Parts& parts) {
  return parse_scene(fmt::format(R"({{"name": "bar", "body": {}, "material": {}, "gravity": [0, 0, 0], "fixed": {}, {}
                                    "integrator": "verlet", "step": 0.001, "duration": 1}})",
                                 parts.body, parts.material, parts.fixed, parts.more),
                     "bar.json", ".");
}
std::string refusal(const Parts& parts) {
  try {
    bar_of_scene(scene(parts));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// 24 x 4 x 4 cells of 1 cm, held by the far end of the third axis: six cubes of 4 cm.
TEST(BarOfScene, IsTheLargestCubesOfABoxTurnedAlongX) {
  const BarOfScene made = bar_of_scene(scene({}));
  EXPECT_EQ(made.bar.cubes, (std::array{6, 1, 1}));
  EXPECT_DOUBLE_EQ(made.bar.spacing, 0.04);
  EXPECT_EQ(made.bar.young, 2e5);
  EXPECT_EQ(made.bar.density, 1100.0);
  EXPECT_EQ(made.poisson, 0.3);
  EXPECT_TRUE(made.omissions.empty());
}

TEST(BarOfScene, IsScaledAsItsBodyIs) {
  Parts parts;
  parts.body = R"({"generate": {"box": {"cells": [8, 2, 2], "spacing": 0.01, "kind": "hexahedra"}}, "scale": 10})";
  parts.fixed = R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])";
  const BarOfScene made = bar_of_scene(scene(parts));
  EXPECT_EQ(made.bar.cubes, (std::array{4, 1, 1}));
  EXPECT_DOUBLE_EQ(made.bar.spacing, 0.2);
}

TEST(BarOfScene, OfSpringsHasTheRatioThatSpringsHave) {
  Parts parts;
  parts.material = R"({"density": 1100, "young": 2e5, "viscosity": 0.1})";
  EXPECT_EQ(bar_of_scene(scene(parts)).poisson, 0.25);
  EXPECT_EQ(bar_of_scene(scene(parts)).omissions,
            std::vector<std::string>{"Damping and viscosity are left out: the bar is bent by its end and let go of."});
}

TEST(BarOfScene, IsNotPutToSleep) {
  SceneFile file = scene(Parts());
  file.sleep = {.speed = 0.001, .time = 0.1};
  EXPECT_EQ(bar_of_scene(file).omissions,
            std::vector<std::string>{"Sleep is left out: the bar is bent by its end and let go of."});
}

TEST(BarOfScene, RefusesWhatIsNoBarHeldAtOneEnd) {
  Parts ball, both, some, free, soft, pulled, cube, mixed, lying;
  ball.body = R"({"generate": {"ball": {"layers": 2, "radius": 0.1}}, "translate": [1, 2, 3.2]})";
  EXPECT_EQ(refusal(ball),
            "bar.json: /body: is no generated box; expected \"generate\": {\"box\": ...}, a bar of cubes");
  both.fixed = R"([{"plane": {"point": [0, 0, 3.2399], "normal": [0, 0, 1]}},
                   {"plane": {"point": [0, 0, 3], "normal": [0, 0, -1]}}])";
  EXPECT_EQ(
      refusal(both),
      "bar.json: /fixed: holds 50 of the 625 points of the box; expected all points of one of its six sides and no "
      "others, as a \"plane\" selects them");
  some.fixed = R"([{"ids": [0, 1]}])";
  EXPECT_NE(refusal(some).find("bar.json: /fixed: holds 2 of the 625"), std::string::npos);
  free.fixed = "[]";
  EXPECT_NE(refusal(free).find("bar.json: /fixed: holds 0 of the 625"), std::string::npos);
  soft.material = R"({"density": 1100, "stiffness": 40})";
  EXPECT_NE(refusal(soft).find("bar.json: /material/young: is missing"), std::string::npos);
  pulled.more = R"("driven": [{"plane": {"point": [0, 0, 3], "normal": [0, 0, -1]}, "velocity": [0, 0, 1]}],)";
  EXPECT_NE(refusal(pulled).find("bar.json: /driven: moves vertices"), std::string::npos);
  pulled.more = R"("attachments": [{"plane": {"point": [0, 0, 3], "normal": [0, 0, -1]}, "stiffness": 1}],)";
  EXPECT_EQ(refusal(pulled), "bar.json: /attachments: is a force; expected a bar held at one end, and no more");
  cube.body =
      R"({"generate": {"box": {"cells": [4, 4, 4], "spacing": 0.06, "pattern": "kuhn"}}, "translate": [1, 2, 3]})";
  EXPECT_NE(refusal(cube).find("bar.json: /body/generate/box/cells: make a box of 1 x 1 x 1"), std::string::npos);
  mixed.more = R"("regions": [{"cells": {"ids": [0]}, "material": {"young": 3e5}}],)";
  EXPECT_EQ(refusal(mixed), "bar.json: /regions/0/material: is one material of several; expected a bar of one");
  lying.more =
      R"("contact": {"pressure": 1, "depth": 1, "obstacles": [{"sphere": {"centre": [9, 9, 9], "radius": 1}}]},)";
  EXPECT_EQ(refusal(lying), "bar.json: /contact: says what touches; expected a bar that touches nothing");
}

}  // namespace
}  // namespace dartboard::bar_of_scene_test
