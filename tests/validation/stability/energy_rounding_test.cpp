// Rounding over many steps, and steps that are lost in it.

#include "validation/stability/energy_rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/time/explicit/compensated_splitting.h"
#include "core/time/integrators.h"
#include "validation/scenes/extreme_bodies.h"

namespace dartboard::energy_rounding_test {
namespace {

// Five points over two decades, each the root of a mean over 64 starts, 9 % of scatter: the slope scatters by 0.05, and
// more where the points of one start depend on each other.
TEST(EnergyRounding, GrowsAsTheSquareRootOfTheSteps) {
  for (const char* name : {"verlet", "verlet-compensated"}) {
    const RoundingGrowth growth = measure_rounding_growth(name, 100000, 64);
    ASSERT_EQ(growth.points.size(), 5u);
    EXPECT_NEAR(growth.exponent, 0.5, 0.15) << name;
  }
}

// A plain state rounds x, near 2, to 2.2e-16 in each step; a compensated one its increments, h omega = 0.05 as large.
TEST(EnergyRounding, IsSmallerWhereTheStateIsCompensated) {
  const auto last = [](const char* name) { return measure_rounding_growth(name, 10000, 16).points.back().error; };
  EXPECT_LT(last("verlet-compensated"), last("verlet") / 10);
  EXPECT_LT(last("blanes-moan-4-compensated"), last("blanes-moan-4") / 10);
}

TEST(EnergyRounding, IsNotKnownOfMethodsThatConserveNoForm) {
  EXPECT_THROW(measure_rounding_growth("rk4", 1000, 1), InputError);
}

TEST(TinySteps, AreLostPlainlyAndKeptByACompensatedState) {
  for (const double h : {1e-18, 1e-16}) {
    EXPECT_EQ(measure_tiny_steps("verlet", h, 100000).lost, 1.0) << h;
    const TinySteps kept = measure_tiny_steps("verlet-compensated", h, 100000);
    EXPECT_TRUE(kept.keeps_all()) << h << ": " << kept.lost << " of " << kept.readable;
    EXPECT_LT(kept.lost_with_digits, 1e-9) << h;
  }
  // 2.5e-14 m a step are 56 units in the last place: some percent are lost by rounding
  const TinySteps half = measure_tiny_steps("verlet", 1e-13, 100000);
  EXPECT_GT(half.lost, 1e-5);
  EXPECT_LT(half.lost, 1e-1);
}

// Verlet conserves v^2 + w q^2, with s = (h omega / 2)^2 of weight w = omega^2 (1 - s) or omega^2 / (1 - s), as it
// begins with a kick or with a drift: its energy error is the change of one of them, from the same draw, and the other,
// which is not conserved, changes by far more.
TEST(EnergyRounding, IsThatOfTheStateWithItsDigitsAfterSoManySteps) {
  constexpr double omega = 2.0, length = 2.0, h = 0.05 / omega;
  constexpr std::uint64_t steps = 1000;
  for (const char* name : {"verlet", "verlet-compensated"}) {
    const RoundingGrowth growth = measure_rounding_growth(name, steps, 1);
    ASSERT_EQ(growth.points.size(), 1u);
    ASSERT_EQ(growth.points[0].steps, steps);
    SplitMix64 random(5);
    const double q = 0.25 * (1.5 + 0.5 * random.next_signed()), v = 0.5 * random.next_signed();
    SpringColumns body = extreme_body("oscillator");
    body.springs = {{length, omega * omega, 0.0}};
    body.x[0] = {0, 0, 0};
    body.x[1] = {length + q, 0, 0};
    body.v[1] = {v, 0, 0};
    const auto integrator = make_integrator(name);
    const auto* compensated = dynamic_cast<const CompensatedSplitting*>(integrator.get());
    const long double s = static_cast<long double>(h) * h * (omega * omega) / 4;
    long double change[2]{}, weight[2]{omega * omega * (1 - s), omega * omega / (1 - s)};
    for (const bool after : {false, true}) {
      for (std::uint64_t k = 0; after && k < steps; ++k)
        ASSERT_TRUE(integrator->step(body.system(), body.motion(), h).ok());
      const bool has_digits = after && compensated != nullptr;
      const long double x = static_cast<long double>(body.x[1].x()) - length +
                            (has_digits ? compensated->lost().x[1].x() : 0.0),
                        u = static_cast<long double>(body.v[1].x()) + (has_digits ? compensated->lost().v[1].x() : 0.0);
      for (int k = 0; k < 2; ++k) {
        const long double energy = u * u + weight[k] * x * x;
        change[k] = after ? std::abs(energy - change[k]) / change[k] : energy;
      }
    }
    const auto least = static_cast<double>(std::min(change[0], change[1]));
    EXPECT_NEAR(growth.points[0].error, least, 1e-3 * least) << name;
  }
}

}  // namespace
}  // namespace dartboard::energy_rounding_test
