// Faults of a run are reported before its first step, with the place.

#include "core/time/watch/preflight.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "tests/support/bodies/element_body_for_tests.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::preflight_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Preflight check(SpringArrays& body, double h, const char* name = "verlet") {
  StableStepEstimate estimate;
  const StableStep limits = estimate.refresh(body.system(), body.x);
  return check_before_run(body.system(), body.motion(), scheme_of(name), h, limits);
}

void expect_refused(SpringArrays body, StepCode code, Witness witness, std::uint32_t number, double h = 1e-3) {
  const StepResult refused = check(body, h).refused;
  EXPECT_EQ(refused.code, code) << to_string(refused);
  EXPECT_EQ(refused.witness, witness) << to_string(refused);
  EXPECT_EQ(refused.number, number) << to_string(refused);
}

TEST(Preflight, SaysNothingOfAGoodRun) {
  SpringArrays body = spring_grid(2, 2, 2);
  const Preflight result = check(body, 1e-3);
  EXPECT_TRUE(result.refused.ok());
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Preflight, RefusesNumbersThatAreNotFiniteOrNotPositive) {
  const SpringArrays good = spring_grid(1, 1, 1);
  for (const double bad : {nan, infinity}) {
    SpringArrays body = good;
    body.x[2][0] = bad;
    expect_refused(body, StepCode::nonfinite, Witness::vertex, 2);
    body = good;
    body.mass[3] = bad;
    expect_refused(body, StepCode::nonfinite, Witness::vertex, 3);
    body = good;
    body.springs[4].rest_length = bad;
    expect_refused(body, StepCode::nonfinite, Witness::edge, 4);
    expect_refused(good, StepCode::nonfinite, Witness::none, 0, bad);
  }
  SpringArrays body = good;
  body.mass[5] = 0.0;
  expect_refused(body, StepCode::mass_not_positive, Witness::vertex, 5);
  body.fixed[5] = 1;
  EXPECT_TRUE(check(body, 1e-3).refused.ok());
  body = good;
  body.springs[6].stiffness = -1.0;
  expect_refused(body, StepCode::bad_scaling, Witness::edge, 6);
  body = good;
  body.v[1] = {1e150, 0, 0};
  expect_refused(body, StepCode::overflow_risk, Witness::vertex, 1);
  expect_refused(good, StepCode::step_underflow, Witness::none, 0, 0.0);
}

TEST(Preflight, WarnsOfAnUnstableStep) {
  SpringArrays body = spring_grid(2, 2, 2);
  EXPECT_TRUE(check(body, 1.0).warns_of(StepCode::unstable_step));
  EXPECT_FALSE(check(body, 1.0, "backward-euler").warns_of(StepCode::unstable_step));
  EXPECT_TRUE(check(body, 1.0, "backward-euler").warns_of(StepCode::bad_scaling));
}

TEST(Preflight, NamesAVertexOfElementsWhoseCoordinatesAreCoarse) {
  ElementBody far(kuhn_box(1, 1, 1, 0.1), Model::neo_hookean, 1e5, 0.3);
  const auto check = [&] {
    return check_before_run(far.system(), far.motion(), scheme_of("verlet"), 1e-4,
                            StableStepEstimate().refresh(far.system(), far.x));
  };
  EXPECT_TRUE(check().warnings.empty());
  for (Eigen::Vector3d& p : far.x) p[0] += 1e9;
  ASSERT_EQ(check().warnings.size(), 1u);
  const StepResult warning = check().warnings[0];
  EXPECT_EQ(warning.code, StepCode::coordinate_precision);
  EXPECT_EQ(warning.witness, Witness::vertex);
  EXPECT_EQ(far.x[warning.number][0], 1e9 + 0.1);
}

TEST(Preflight, WarnsOfRoundingZeroLengthsAndDenormals) {
  SpringArrays far = spring_grid(1, 1, 1);
  // 2^-52 * 1e9 / 0.1 is 2e-6
  for (Eigen::Vector3d& p : far.x) p[0] += 1e9;
  EXPECT_TRUE(check(far, 1e-3).warns_of(StepCode::coordinate_precision));
  SpringArrays flat = spring_grid(1, 1, 1);
  flat.x[flat.ends[3][0]] = flat.x[flat.ends[3][1]];
  EXPECT_TRUE(check(flat, 1e-3).warns_of(StepCode::zero_length));
  SpringArrays slow = spring_grid(1, 1, 1);
  slow.v[0] = {1e-310, 0, 0};
  EXPECT_TRUE(check(slow, 1e-3).warns_of(StepCode::bad_scaling));
  SpringArrays light = spring_grid(1, 1, 1);
  light.mass[2] = 1e-310;
  light.inverse_mass[2] = 1e300;
  EXPECT_TRUE(check(light, 1e-3).warns_of(StepCode::bad_scaling));
  SpringArrays soft = spring_grid(1, 1, 1);
  soft.springs[1].stiffness = 1e-310;
  EXPECT_TRUE(check(soft, 1e-3).warns_of(StepCode::bad_scaling));
  SpringArrays still = spring_grid(1, 1, 1);
  for (Eigen::Vector3d& p : still.x) p[1] += 1.0;
  for (Eigen::Vector3d& v : still.v) v = {1, 1, 1};
  EXPECT_TRUE(check(still, 1e-18).warns_of(StepCode::step_underflow));
}

}  // namespace
}  // namespace dartboard::preflight_test
