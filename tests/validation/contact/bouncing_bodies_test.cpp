// Bodies as users have them keep the restitution of their law, and a floor that leaves them never pulls.

#include "validation/contact/bouncing_bodies.h"

#include <gtest/gtest.h>

namespace dartboard::bouncing_bodies_test {
namespace {

// 200 steps in contact; a body that is ten times as stiff as it has up to a hundredth more or less by its own
// vibrations, and a method of order 1 twice as much.
TEST(BouncingBodies, KeepTheirRestitutionAndAreNotPulled) {
  std::size_t stiff = 0;
  for (const BouncingBody& body : bouncing_bodies())
    for (const char* integrator : {"verlet", "ros2", "backward-euler"}) {
      const bool is_first_order = std::string_view(integrator) == "backward-euler";
      const BounceFound found = bounce_body(body, integrator, 0.5);
      ASSERT_TRUE(found.ended) << body.name << ' ' << integrator;
      // less than what Newton's method leaves of the force in a step
      EXPECT_LE(found.pulled, is_first_order ? 1e-11 : 1e-15) << body.name << ' ' << integrator;
      if (body.stiffness < 10.0) continue;
      ++stiff;
      EXPECT_NEAR(found.found, 0.5, is_first_order ? 0.03 : 0.015) << body.name << ' ' << integrator;
    }
  EXPECT_GE(stiff, 12u);
}

}  // namespace
}  // namespace dartboard::bouncing_bodies_test
