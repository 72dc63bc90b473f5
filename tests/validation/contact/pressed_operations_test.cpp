#include "validation/contact/pressed_operations.h"

#include <gtest/gtest.h>

namespace dartboard::pressed_operations_test {
namespace {

TEST(PressedOperations, KeepTheSkinTheSumsAndTheOverlaps) {
  std::size_t last = 0;
  const PressedOperations found =
      operate_under_pressure({.operations = 150, .look_every = 50, .seed = 3}, [&last](std::size_t k) { last = k; });
  EXPECT_TRUE(found.ended);
  EXPECT_EQ(last, 150u);
  EXPECT_EQ(found.operations(), 150u);
  EXPECT_GT(found.dissociated, 50u);
  EXPECT_GT(found.torn, 5u);
  EXPECT_GT(found.removed, 5u);
  EXPECT_EQ(found.looks, 3u);
  EXPECT_EQ(found.strangers, 0u);
  EXPECT_EQ(found.invalid, 0u);
  EXPECT_LE(found.elastic, 1e-14);
  EXPECT_LE(found.sums, 1e-14);
  EXPECT_LE(found.contact, 1e-14);
  EXPECT_EQ(found.across, 0.0);
  EXPECT_GT(found.reopened, 0.0);
  EXPECT_LE(found.energy, 0.05);
  EXPECT_GT(found.energy, 0.0);
  EXPECT_LE(found.momentum, 1e-14);
  EXPECT_LE(found.angular, 1e-14);
  EXPECT_GT(found.contacts, 50u);
  EXPECT_GT(found.by_depth.count(), 300u);
  EXPECT_LE(found.by_depth.deepest, 0.75);
  EXPECT_GT(found.of_neighbours.count(), 30u);
}

// A new stack takes the place of one that is used up.
TEST(PressedOperations, GoOnWithAnotherStack) {
  const PressedOperations found = operate_under_pressure({.operations = 320, .look_every = 320});
  EXPECT_TRUE(found.ended);
  EXPECT_GE(found.stacks, 2u);
  EXPECT_EQ(found.strangers, 0u);
}

TEST(PressedOperations, SeeASkinThatIsNotFollowed) {
  const PressedOperations found = operate_under_pressure(
      {.operations = 40, .look_every = 40, .forgets = [](std::size_t operation) { return operation % 10 == 0; }});
  EXPECT_EQ(found.strangers, 4u);
}

TEST(PressedOperations, SeeBodiesWhoseContactIsWeak) {
  const PressedOperations found = operate_under_pressure({.operations = 250, .look_every = 50, .strength = 1e-6});
  EXPECT_GT(found.by_depth.deepest, 0.75);
}

TEST(PressedOperations, SeeWhatAnOperationAdds) {
  const auto altered = [](const std::function<void(VertexColumns&)>& alters) {
    return operate_under_pressure(
        {.operations = 6, .look_every = 6, .meddles = [&alters](std::size_t operation, VertexColumns& v) {
           if (operation == 5) alters(v);
         }});
  };
  const PressedOperations faster = altered([](VertexColumns& v) { v.velocity[0].x() += 1e-6; });
  EXPECT_LE(faster.elastic, 1e-14);
  EXPECT_GT(faster.sums, 1e-13);
  const PressedOperations moved = altered([](VertexColumns& v) { v.position[0].x() += 1e-6; });
  EXPECT_GT(moved.elastic, 1e-13);
  // moved by another mass than that of the sums
  const PressedOperations lighter = altered([](VertexColumns& v) { v.inverse_mass[0] *= 1.5; });
  EXPECT_LE(lighter.sums, 1e-14);
  EXPECT_GT(lighter.momentum, 1e-9);
  EXPECT_GT(lighter.angular, 1e-9);
  EXPECT_GT(lighter.energy, 1e-6);
}

}  // namespace
}  // namespace dartboard::pressed_operations_test
