#include "validation/scenes/order_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/time/integrators.h"
#include "tests/support/moving_box.h"

namespace dartboard::order_limit_test {
namespace {

using namespace moving;

OrderLimit order_of(const char* contact) {
  Json json = moving_box();
  json["contact"] = Json::parse(R"({"pressure": 1, "depth": 1})");
  json["contact"].merge_patch(Json::parse(contact));
  return order_limit(parse(json));
}

TEST(OrderLimit, LeavesAllWithoutContact) {
  const OrderLimit found = order_limit(parse(moving_box()));
  EXPECT_TRUE(std::isinf(found.most));
  EXPECT_EQ(found.because, "");
}

TEST(OrderLimit, IsTheExponentOfTheEnergy) {
  const OrderLimit found =
      order_of(R"({"exponent": 4, "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  EXPECT_EQ(found.most, 4.0);
  EXPECT_EQ(found.because, "an energy of exponent 4");
}

TEST(OrderLimit, IsTwoWhereSpeedIsLost) {
  const OrderLimit found =
      order_of(R"({"restitution": 0.5, "obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}}]})");
  EXPECT_EQ(found.most, 2.0);
  EXPECT_EQ(found.because, "speed that is lost");
}

TEST(OrderLimit, IsTwoWithObstaclesThatMove) {
  EXPECT_EQ(order_of(R"({"obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}, "velocity": [0, 0, 1]}]})").most,
            2.0);
}

TEST(OrderLimit, IsTwoUnderLoadsThatChangeInTimeAndOneForTheMethodOfTwoSteps) {
  Json json = moving_box();
  json["forces"] = Json::parse(R"([{"ids": [0], "force": [1, 0, 0], "over_time": [{"at": 0, "factor": 2}]}])");
  const OrderLimit found = order_limit(parse(json));
  EXPECT_EQ(found.because, "loads that change in time");
  EXPECT_EQ(found.of(scheme_of("rk4")), 2.0);
  EXPECT_EQ(found.of(scheme_of("explicit-euler")), 1.0);
  EXPECT_EQ(found.of(scheme_of("bdf2")), 1.0);
  EXPECT_EQ(order_limit(parse(moving_box())).of(scheme_of("bdf2")), 2.0);
}

TEST(OrderLimit, IsTwoForTheMethodOfTwoStepsTooWhereVerticesAreDrivenOverTime) {
  for (const char* drive : {R"("path": [{"at": 0, "place": [0, 0, 0]}, {"at": 0.01, "place": [0.02, 0, 0]}])",
                            R"("turn": {"axis": [1, 0, 0], "centre": [0, 0, 0],
                                        "angles": [{"at": 0, "degrees": 0}, {"at": 0.01, "degrees": 10}]})"}) {
    Json json = moving_box();
    json["driven"] = Json::parse(std::string(R"([{"ids": [0], )") + drive + "}]");
    const OrderLimit found = order_limit(parse(json));
    EXPECT_EQ(found.because, "loads that change in time");
    EXPECT_EQ(found.of(scheme_of("bdf2")), 2.0) << drive;
    EXPECT_EQ(found.of(scheme_of("rk4")), 2.0) << drive;
  }
}

TEST(OrderLimit, IsOneWithFriction) {
  const OrderLimit found = order_of(
      R"({"restitution": 0.5, "friction": 0.1, "obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}}]})");
  EXPECT_EQ(found.most, 1.0);
  EXPECT_EQ(found.because, "friction");
}

TEST(OrderLimit, IsNoneWithBoxesAndBodies) {
  EXPECT_FALSE(order_of(R"({"obstacles": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]})").is_promised());
  const OrderLimit bodies = order_of(R"({"friction": 0.1, "bodies": "themselves"})");
  EXPECT_FALSE(bodies.is_promised());
  EXPECT_EQ(bodies.because, "bodies, whose nearest face changes");
}

}  // namespace
}  // namespace dartboard::order_limit_test
