// Cuts by a blade that is moved through the body.

#include <gtest/gtest.h>

#include "core/plain/error.h"
#include "tests/support/moving_box.h"

namespace dartboard::blade_test {
namespace {

using namespace moving;

Json cut(Json scene, Json path, Json depth) {
  Json event;
  event["at"] = 0;
  event["dissociate"]["blade"] = {{"path", std::move(path)}, {"depth", std::move(depth)}};
  scene["events"] = Json::array({event});
  return scene;
}

// 4 x 4 squares of 0.25 m in the plane z = 0; a blade through it stands upright.
Json sheet() {
  Json scene = moving_box();
  scene["body"] =
      Json::parse(R"({"generate": {"sheet": {"cells": [4, 4], "spacing": 0.25, "kind": "quadrilaterals"}}})");
  return scene;
}

TEST(Blade, ThatPassesTheWholeBodyCutsAsThePlaneDoes) {
  const Json across = cut(moving_box(), {{0.125, -1, -1}, {0.125, 1, -1}}, {0, 0, 2});
  const Simulation blade(parse(across)), plane(parse(with_events(moving_box(), R"([{"at": 0, "dissociate": {"plane":
                                             {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])")));
  EXPECT_EQ(blade.operations(), 8u);
  EXPECT_EQ(blade.body().state_hash(), plane.body().state_hash());
  EXPECT_EQ(blade.body().counts(), plane.body().counts());
  EXPECT_EQ(blade.body().violation(), "");
}

// The planes of its sides halve the box at heights of 0.125 m.
TEST(Blade, CutsAsDeepAsItReaches) {
  EXPECT_EQ(Simulation(parse(cut(moving_box(), {{0.125, -1, -1}, {0.125, 1, -1}}, {0, 0, 1.125}))).operations(), 4u);
  EXPECT_EQ(Simulation(parse(cut(moving_box(), {{0.125, -1, -1}, {0.125, 1, -1}}, {0, 0, 0.5}))).operations(), 0u);
}

TEST(Blade, ThatTurnsAQuarterCutsACornerOut) {
  const Simulation corner(parse(cut(sheet(), {{0.5, -1, -1}, {0.5, 0.5, -1}, {2, 0.5, -1}}, {0, 0, 2})));
  EXPECT_EQ(corner.operations(), 4u);  // two edges on each side of the corner
  EXPECT_EQ(corner.body().counts().components, 2u);
  EXPECT_EQ(corner.body().counts().vertices, 25u + 5u);
}

TEST(Blade, ThatStopsInsideLeavesTheBodyInOnePiece) {
  const Simulation slit(parse(cut(sheet(), {{0.5, -1, -1}, {0.5, 0.5, -1}}, {0, 0, 2})));
  EXPECT_EQ(slit.operations(), 2u);
  EXPECT_EQ(slit.body().counts().components, 1u);
  EXPECT_EQ(slit.body().counts().vertices, 25u + 2u);  // at the border and within; the tip stays
}

TEST(Blade, CutsAlikeWhicheverWayItGoes) {
  const Simulation there(parse(cut(sheet(), {{0.3, -1, -1}, {0.6, 0.5, -1}, {2, 0.6, -1}}, {0, 0, 2}))),
      back(parse(cut(sheet(), {{2, 0.6, 1}, {0.6, 0.5, 1}, {0.3, -1, 1}}, {0, 0, -2})));
  EXPECT_GT(there.operations(), 0u);
  EXPECT_EQ(there.body().state_hash(), back.body().state_hash());
  EXPECT_EQ(there.body().counts(), back.body().counts());
}

TEST(Blade, ThatSweepsNothingIsRefused) {
  for (const Json& path : {Json{{0, 0, 0}, {0, 0, 0}}, Json{{0, 0, 0}, {1, 0, 0}, {1, 0, 2}}}) {
    try {
      parse(cut(moving_box(), path, {0, 0, 1}));
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/events/0/dissociate/blade/path/" + std::to_string(path.size() - 1)),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace dartboard::blade_test
