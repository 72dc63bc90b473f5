#include "validation/order/implicit_gains.h"
#include "benchmarks/checkout/source_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace dartboard::implicit_gains_test {
namespace {

// The equations are solved to rounding, so that the energy walks by some 1e-16 a step.
TEST(ConservedDrift, StaysAtRoundingAcrossACutAtLargeSteps) {
  const ConservedDrift found = measure_energy_drift(100, 20.0);
  EXPECT_EQ(found.diagnosis, "");
  EXPECT_GT(found.vertices_after, found.vertices_before);
  EXPECT_GT(found.drift, 0.0);
  EXPECT_LE(found.drift, 1e-12);
}

TEST(KeptFactor, SavesTenFactorisationsOutOfElevenForLessThanTheErrorOfTheStep) {
  const KeptFactor found = compare_kept_factor(16, source_folder().string() + "/benchmarks/meshes");
  EXPECT_EQ(found.diagnosis, "");
  EXPECT_GE(found.fresh, 10 * found.kept);
  EXPECT_GT(found.step_error, 0.0);
  EXPECT_LE(found.difference, 1e-3 * found.step_error);
}

}  // namespace
}  // namespace dartboard::implicit_gains_test
