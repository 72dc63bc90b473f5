#include "validation/scenes/contact_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/moving_box.h"

namespace dartboard::contact_order_test {
namespace {

using namespace moving;

ContactOrder order_of(const char* contact) {
  Json json = moving_box();
  json["contact"] = Json::parse(R"({"pressure": 1, "depth": 1})");
  json["contact"].merge_patch(Json::parse(contact));
  return contact_order(parse(json));
}

TEST(ContactOrder, LeavesAllWithoutContact) {
  const ContactOrder found = contact_order(parse(moving_box()));
  EXPECT_TRUE(std::isinf(found.most));
  EXPECT_EQ(found.because, "");
}

TEST(ContactOrder, IsTheExponentOfTheEnergy) {
  const ContactOrder found =
      order_of(R"({"exponent": 4, "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  EXPECT_EQ(found.most, 4.0);
  EXPECT_EQ(found.because, "an energy of exponent 4");
}

TEST(ContactOrder, IsHalfTheExponentWhereSpeedIsLost) {
  EXPECT_EQ(order_of(R"({"restitution": 0.5, "obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}}]})").most,
            1.5);
}

TEST(ContactOrder, IsTwoWithObstaclesThatMove) {
  EXPECT_EQ(order_of(R"({"obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}, "velocity": [0, 0, 1]}]})").most,
            2.0);
}

TEST(ContactOrder, IsOneWithFriction) {
  const ContactOrder found = order_of(
      R"({"restitution": 0.5, "friction": 0.1, "obstacles": [{"sphere": {"centre": [0, 0, 0], "radius": 1}}]})");
  EXPECT_EQ(found.most, 1.0);
  EXPECT_EQ(found.because, "friction");
}

TEST(ContactOrder, IsNoneWithBoxesAndBodies) {
  EXPECT_FALSE(order_of(R"({"obstacles": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]})").is_promised());
  const ContactOrder bodies = order_of(R"({"friction": 0.1, "bodies": "themselves"})");
  EXPECT_FALSE(bodies.is_promised());
  EXPECT_EQ(bodies.because, "bodies, whose nearest face changes");
}

}  // namespace
}  // namespace dartboard::contact_order_test
