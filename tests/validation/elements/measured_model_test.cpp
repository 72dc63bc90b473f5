#include "validation/elements/measured_model.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"

namespace dartboard::measured_model_test {
namespace {

TEST(BarMeshes, AreAsFineAsFactorsAllow) {
  const BarMeshes cantilever = bar_meshes({}, false);
  EXPECT_EQ(cantilever.models, (std::vector{1, 2, 3, 4, 6, 8}));
  EXPECT_EQ(cantilever.truth, 6);
  const BarMeshes slender = bar_meshes({.cubes = {20, 1, 1}}, false);
  EXPECT_EQ(slender.models, (std::vector{1, 2, 3, 4}));
  EXPECT_EQ(slender.truth, 2);
  EXPECT_EQ(bar_meshes({}, true).models, (std::vector{1, 2}));
  EXPECT_THROW(bar_meshes({.cubes = {23, 4, 4}}, true), InputError);
}

// A coarser reference is off by more than the truth by another code (cantilever_test.cpp) is, and by less than a tenth.
TEST(BarTruth, KnowsHowFarOneHalfAsFineIsOff) {
  const BarTruth truth = bar_truth({}, {.models = {}, .truth = 2}, 0.25);
  EXPECT_GT(truth.unsure.tip, 0.01);
  EXPECT_LT(truth.unsure.tip, 0.1);
  EXPECT_LT(truth.unsure.confined, 1e-12);
  EXPECT_EQ(truth.poisson, 0.25);
}

TEST(MeasuredModel, IsSteppedSoThatItsErrorIsItsOwn) {
  const ClampedBar bar;
  const BarTruth truth = bar_truth(bar, {.models = {}, .truth = 2}, 0.25);
  std::int64_t now = 0;
  const auto clock = [&now] { return now += 1000; };
  const MeasuredModel m = measure_model(bar, {Model::neo_hookean, CellKind::hexahedron}, 2, truth, clock);
  ASSERT_FALSE(m.method.integrator.empty());
  EXPECT_DOUBLE_EQ(m.allowed, 0.1 * m.model_motion);
  EXPECT_LE(m.method.error, m.allowed);
  EXPECT_NEAR(m.errors.motion, m.model_motion, m.allowed);
  EXPECT_NE(m.errors.motion, m.model_motion);
  EXPECT_NEAR(m.errors.tip, 0.12, 0.015);
  EXPECT_DOUBLE_EQ(m.h * static_cast<double>(m.method.steps), truth.beats.period);
}

}  // namespace
}  // namespace dartboard::measured_model_test
