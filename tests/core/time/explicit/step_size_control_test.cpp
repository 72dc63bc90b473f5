// The steps chosen by Dormand and Prince's method, compared with an implementation of the method and of its controller
// that shares nothing with core, and with the requirements of tolerances, restarts and the end of an interval.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/plain/error.h"
#include "core/time/explicit/dormand_prince_54.h"
#include "core/time/integrators.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::step_size_control_test {
namespace {

using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

SpringArrays a_body(double damping, double viscosity) {
  Problem problem;
  problem.mesh = kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material.damping = damping;
  problem.material.viscosity = viscosity;
  problem.surroundings.gravity = {0, 0, 0};
  SpringArrays arrays = arrays_of(build_body<TetMap, Held::by_one_dart>(problem));
  disturb(arrays);
  return arrays;
}

void run(Integrator& integrator, SpringArrays& arrays, double h, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_TRUE(integrator.step(arrays.system(), arrays.motion(), h).ok());
}

bool same_bits(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector3d)) == 0;
}

struct Adaptive : testing::Test {
  DormandPrince54 integrator;

  static double distance(const SpringArrays& a, const SpringArrays& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) sum += (a.x[i] - b.x[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.x.size()));
  }
};

// ---- against an oracle

// A mass of 1 kg on a spring of length 2 at a wall, at q = x - 2; a linear oscillator.
constexpr double omega2 = 4.0, drag = 0.25;
SpringArrays oscillator() {
  SpringArrays arrays;
  const auto wall = arrays.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
  arrays.add_spring(wall, arrays.add_vertex(1.0, {2.125, 0, 0}, {0.25, 0, 0}), omega2, 2.0, drag);
  return arrays;
}

// The tableau as it is printed in Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, table II.5.2:
// both solutions by their own weights.
constexpr double stages[7][6] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
constexpr double fourth[7] = {5179.0 / 57600,    0.0,          7571.0 / 16695, 393.0 / 640,
                              -92097.0 / 339200, 187.0 / 2100, 1.0 / 40};

// The oscillator under the PI control of Hairer, Norsett, Wanner (II, section IV.2; exponents of their DOPRI5).
struct Controlled {
  double h, q = 0.125, v = 0.25, previous = 1.0;
  int taken = 0, rejected = 0;

  void run(double duration, const Tolerance& tolerance, double vertices) {
    bool after_rejection = false;
    for (double t = 0.0; t < duration;) {
      const bool last = 1.01 * h >= duration - t;  // less than a hundredth of a step is not left over
      const double step = last ? duration - t : h;
      double kq[7], kv[7], at_q = q, at_v = v;
      for (int s = 0; s < 7; ++s) {
        at_q = q;
        at_v = v;
        for (int j = 0; j < s; ++j) {
          at_q += step * stages[s][j] * kq[j];
          at_v += step * stages[s][j] * kv[j];
        }
        kq[s] = at_v;
        kv[s] = -omega2 * at_q - drag * at_v;
      }
      double error_q = 0.0, error_v = 0.0;
      for (int s = 0; s < 7; ++s) {
        const double difference = (s < 6 ? stages[6][s] : 0.0) - fourth[s];
        error_q += step * difference * kq[s];
        error_v += step * difference * kv[s];
      }
      // the mean over all vertices, and over positions and velocities
      const double error = std::sqrt(
          (std::pow(error_q / tolerance.position, 2) + std::pow(error_v / tolerance.velocity, 2)) / (2 * vertices));
      if (error > 1.0) {
        ++rejected;
        h = step * std::max(0.1, 0.9 * std::pow(error, -0.17));
        after_rejection = true;
        continue;
      }
      q = at_q;
      v = at_v;
      t = last ? duration : t + step;
      ++taken;
      const double counted = std::max(error, 1e-4);
      double factor = 0.9 * std::pow(counted, -0.17) * std::pow(previous, 0.04);
      if (after_rejection) factor = std::min(factor, 1.0);
      if (!last || step * factor > h) h = step * factor;
      previous = counted;
      after_rejection = false;
    }
  }
};

// Estimates are sums of terms near h that cancel down to the tolerance, at the finest to 1e-13: they are rounded to a
// hundred-thousandth, of which the step takes a sixth. Without memory steps are 1 to 5 % longer.
TEST_F(Adaptive, TakesTheStepsOfThePiController) {
  int rejected = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9, 1e-12})
    for (const double ratio : {0.1, 2.0, 10.0}) {  // of what is asked for in velocities and in positions
      const Tolerance asked{tolerance, ratio * tolerance};
      SpringArrays arrays = oscillator();
      Controlled oracle{.h = 0.5 / std::sqrt(2 * omega2)};
      integrator.restart();
      integrator.reset_work();
      for (const double duration : {10.0, 0.01, 3.0}) {  // the one in the middle ends within a step
        ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), duration, asked).ok());
        oracle.run(duration, asked, 2.0);
        EXPECT_NEAR(integrator.next_step(), oracle.h, 1e-4 * oracle.h) << tolerance << ", " << ratio;
        EXPECT_NEAR(arrays.x[1].x() - 2.0, oracle.q, 1e-2 * tolerance + 1e-12) << tolerance << ", " << ratio;
      }
      EXPECT_EQ(integrator.work().steps, static_cast<std::uint64_t>(oracle.taken)) << tolerance << ", " << ratio;
      EXPECT_EQ(integrator.work().rejected_steps, static_cast<std::uint64_t>(oracle.rejected)) << tolerance;
      rejected += oracle.rejected;
    }
  EXPECT_GT(rejected, 10);
}

// Steps as long as the first call leaves them are near the limit of stability, where errors fall faster than the
// controller expects: the step after a rejection is better than needed, and the next one must not be longer for that
// reason. The motion is so small that errors of its size do not turn the spring round.
TEST_F(Adaptive, DoesNotGrowStraightAfterARejection) {
  constexpr double small = 1.0 / 1024;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6})
    for (const double ratio : {0.1, 10.0}) {
      SpringArrays arrays = oscillator();
      Controlled oracle{.h = 0.5 / std::sqrt(2 * omega2)};
      arrays.x[1].x() = 2.0 + small * oracle.q;
      arrays.v[1].x() = small * oracle.v;
      integrator.restart();
      for (const auto& [duration, asked] : {std::pair{10.0, 1.0}, {3.0, tolerance}}) {
        const double scaled = small * asked;
        ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), duration, {scaled, ratio * scaled}).ok());
        oracle.run(duration, {asked, ratio * asked}, 2.0);
        EXPECT_NEAR(integrator.next_step(), oracle.h, 1e-4 * oracle.h) << tolerance << ", " << ratio;
      }
    }
}

// ---- the mean over the vertices, the first step, restarts

// Side by side and not joined, so that every sum is twice what it was, but for its rounding.
TEST_F(Adaptive, TakesTheSameStepsForTwoCopiesOfABody) {
  SpringArrays one = a_body(0.5, 0.25), two = one;
  const auto n = static_cast<std::uint32_t>(one.x.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    two.add_vertex(one.mass[i], one.x[i], one.v[i]);
    two.inverse_mass.back() = one.inverse_mass[i];
    two.viscosity.back() = one.viscosity[i];
  }
  for (std::size_t s = 0; s < one.springs.size(); ++s) {
    two.ends.push_back({one.ends[s][0] + n, one.ends[s][1] + n});
    two.springs.push_back(one.springs[s]);
  }
  DormandPrince54 other;
  ASSERT_TRUE(integrator.advance(one.system(), one.motion(), 1.0, {1e-7, 1e-6}).ok());
  ASSERT_TRUE(other.advance(two.system(), two.motion(), 1.0, {1e-7, 1e-6}).ok());
  EXPECT_EQ(other.work().steps, integrator.work().steps);
  EXPECT_NEAR(other.next_step(), integrator.next_step(), 1e-6 * integrator.next_step());
}

// The bound of the frequency is sqrt(2 k / m), for k = 8 exactly 4: half of one over that is 1/8. What is advanced by
// is shorter, and a fivefold growth from there does not reach it.
TEST_F(Adaptive, TriesHalfOfOneOverTheFrequencyBoundFirst) {
  SpringArrays arrays = oscillator();
  arrays.springs[0].stiffness = 8.0;
  EXPECT_EQ(integrator.next_step(), 0.0);
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 1.0 / 64, {1e-6, 1e-6}).ok());
  EXPECT_EQ(integrator.next_step(), 1.0 / 8);
}

TEST_F(Adaptive, KeepsItsStepFromCallToCallUntilARestart) {
  SpringArrays arrays = oscillator();
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 5.0, {1e-9, 1e-9}).ok());
  const double found = integrator.next_step();
  EXPECT_LT(found, 0.1);
  const auto steps = integrator.work().steps;
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), found / 2, {1e-9, 1e-9}).ok());
  EXPECT_EQ(integrator.work().steps, steps + 1);
  EXPECT_EQ(integrator.next_step(), found);
  integrator.restart();
  EXPECT_EQ(integrator.next_step(), 0.0);
}

// The first body has no damping, and ends with an error below 1, which the controller would remember.
TEST_F(Adaptive, HasForgottenTheBodyBeforeARestart) {
  SpringArrays before = a_body(0.0, 0.0), used = a_body(0.5, 0.25), fresh = used;
  ASSERT_TRUE(integrator.advance(before.system(), before.motion(), 0.5, {1e-5, 1e-3}).ok());
  integrator.restart();
  integrator.reset_work();
  DormandPrince54 other;
  ASSERT_TRUE(integrator.advance(used.system(), used.motion(), 1.0, {1e-6, 1e-5}).ok());
  ASSERT_TRUE(other.advance(fresh.system(), fresh.motion(), 1.0, {1e-6, 1e-5}).ok());
  EXPECT_EQ(integrator.next_step(), other.next_step());
  EXPECT_EQ(integrator.work().steps, other.work().steps);
  EXPECT_TRUE(same_bits(used.x, fresh.x));
  EXPECT_TRUE(same_bits(used.v, fresh.v));
}

// ---- guarantees to users

// The errors of some tens of steps, each within the tolerance, add up; the error of the solution of order 5 that is
// kept is smaller than that of order 4 which is estimated.
TEST_F(Adaptive, StaysNearTheToleranceAndWorksHarderForASmallerOne) {
  SpringArrays exact = a_body(0.5, 0.25);
  const SpringArrays start = exact;
  run(*make_integrator("rk4"), exact, 1.0 / 4096, 4096);
  std::uint64_t before = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    SpringArrays arrays = start;
    integrator.restart();
    integrator.reset_work();
    ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 1.0, {tolerance, 10 * tolerance}).ok());
    EXPECT_LT(distance(arrays, exact), 20 * tolerance);
    EXPECT_GT(integrator.work().steps, before);
    before = integrator.work().steps;
  }
}

TEST_F(Adaptive, EndsWhereItIsAskedTo) {
  SpringArrays arrays;
  arrays.add_vertex(1.0, {0, 0, 0}, {1, 0, 0});  // uniform motion shows the time
  for (const double duration : {0.3, 0.0, 1e-5, 0.69999}) {
    ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), duration, {1e-8, 1e-8}).ok());
  }
  EXPECT_NEAR(arrays.x[0].x(), 1.0, 100 * u);
}

TEST_F(Adaptive, LeavesNoCrumbOfAStepToTheEnd) {
  SpringArrays arrays = oscillator();
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 5.0, {1e-6, 1e-6}).ok());
  for (const double share : {0.995, 1.005}) {
    integrator.reset_work();
    ASSERT_TRUE(
        integrator.advance(arrays.system(), arrays.motion(), share * integrator.next_step(), {1e-6, 1e-6}).ok());
    EXPECT_EQ(integrator.work().steps, 1u) << share;
  }
}

TEST_F(Adaptive, SparesTheEvaluationThatTwoStepsShare) {
  SpringArrays arrays = a_body(0.0, 0.0);
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 1.0, {1e-6, 1e-5}).ok());
  const WorkCounters& work = integrator.work();
  EXPECT_GT(work.steps, 5u);
  EXPECT_EQ(work.force_evaluations, 1 + 6 * (work.steps + work.rejected_steps));
}

TEST_F(Adaptive, FindsItsWayFromAFirstStepThatIsFarTooLong) {
  SpringArrays arrays = a_body(0.0, 0.0), exact = arrays;
  for (auto* each : {&arrays, &exact})
    for (auto& velocity : each->v) velocity *= 20.0;  // twice through the body: faster than frequencies at rest predict
  ASSERT_TRUE(integrator.advance(arrays.system(), arrays.motion(), 0.25, {1e-8, 1e-7}).ok());
  run(*make_integrator("rk4"), exact, 0.25 / 16384, 16384);
  EXPECT_GT(integrator.work().rejected_steps, 0u);
  EXPECT_LT(distance(arrays, exact), 1e-6);
}

TEST_F(Adaptive, SaysWhenNoStepIsSmallEnough) {
  SpringArrays arrays = a_body(0.0, 0.0);
  const StepResult result = integrator.advance(arrays.system(), arrays.motion(), 1.0, {1e-300, 1e-300});
  EXPECT_EQ(result.code, StepCode::step_underflow) << to_string(result);
  EXPECT_EQ(result.quantity, "step");
  EXPECT_LT(result.value, 1e-15);
  EXPECT_EQ(integrator.work().failed_steps, 1u);
  EXPECT_GT(integrator.work().rejected_steps, 10u);  // by a tenth at most
  for (const Vector3d& x : arrays.x) EXPECT_TRUE(x.allFinite());
}

TEST_F(Adaptive, DiagnosesAStartThatIsNotFinite) {
  SpringArrays arrays = a_body(0.0, 0.0);
  arrays.x[7].z() = std::numeric_limits<double>::infinity();
  const StepResult result = integrator.advance(arrays.system(), arrays.motion(), 1.0, {1e-6, 1e-6});
  EXPECT_EQ(to_string(result), "NONFINITE at vertex 7: position = inf");
  EXPECT_EQ(integrator.work().failed_steps, 1u);
}

TEST_F(Adaptive, RefusesWhatItCannotMeet) {
  SpringArrays arrays = a_body(0.0, 0.0);
  EXPECT_THROW(integrator.advance(arrays.system(), arrays.motion(), -1.0, {1e-6, 1e-6}), InputError);
  EXPECT_THROW(integrator.advance(arrays.system(), arrays.motion(), 1.0, {0.0, 1e-6}), InputError);
  EXPECT_THROW(integrator.advance(arrays.system(), arrays.motion(), 1.0, {1e-6, std::nan("")}), InputError);
}

// A frequency beyond the range of doubles leaves no step to begin with: 2 k / m overflows.
TEST_F(Adaptive, SaysWhenTheFirstStepIsNone) {
  SpringArrays arrays = a_body(0.0, 0.0);
  for (Spring& spring : arrays.springs) spring.stiffness = 1e300;
  for (std::size_t i = 0; i < arrays.mass.size(); ++i) {
    arrays.mass[i] = 1e-100;
    arrays.inverse_mass[i] = 1e100;
  }
  const StepResult result = integrator.advance(arrays.system(), arrays.motion(), 1.0, {1e-6, 1e-5});
  EXPECT_EQ(result.code, StepCode::step_underflow) << to_string(result);
  EXPECT_EQ(result.value, 0.0);
  EXPECT_EQ(integrator.work().failed_steps, 1u);
}

}  // namespace
}  // namespace dartboard::step_size_control_test
