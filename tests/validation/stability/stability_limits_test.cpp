#include "validation/stability/stability_limits.h"

#include <gtest/gtest.h>

#include "validation/cgal/delaunay_ball.h"

namespace dartboard::stability_limits_test {
namespace {

TEST(StabilityLimits, AreWithinTheirToleranceOfTheory) {
  const std::vector<StabilityLimit> limits = measure_stability_limits(true);
  EXPECT_GE(limits.size(), 80u);
  for (const StabilityLimit& l : limits)
    EXPECT_TRUE(l.holds()) << l.body << " " << l.integrator << " zeta " << l.zeta << ": " << l.measured << " for "
                           << l.theory;
}

TEST(StabilityLimits, OnAMeshAreWhereLanczosPutsThemBeforeAndAfterCuts) {
  const std::vector<MeshBody> bodies = mesh_bodies("ball", delaunay_ball(40, 1), 30, 3);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NE(bodies[0].body.springs.size(), bodies[1].body.springs.size());
  for (const MeshBody& body : bodies) {
    EXPECT_TRUE(body.proven) << body.name;
    EXPECT_LE(body.lower, body.omega + body.error) << body.name;
    EXPECT_GE(body.upper, body.omega - body.error) << body.name;
    EXPECT_LE(body.upper, 1.1 * body.omega) << body.name;
  }
  const std::vector<StabilityLimit> limits = measure_mesh_limits(bodies, true);
  EXPECT_GE(limits.size(), 14u);
  for (const StabilityLimit& l : limits)
    EXPECT_TRUE(l.holds()) << l.body << " " << l.integrator << ": " << l.measured << " for " << l.theory;
}

}  // namespace
}  // namespace dartboard::stability_limits_test
