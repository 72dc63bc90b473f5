// The bounds of conservation: their derived values, and their application.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "validation/conservation/conservation_ledger.h"
#include "validation/conservation/conserved_sums.h"

namespace dartboard::conservation_bounds_test {
namespace {

constexpr double u = 0x1p-53;

struct OneCheck {
  ConservationResult result;
  ConservationLedger ledger{result, 7, std::array{Check::total_mass}};
  bool within(double deviation, double bound, double scale = 1.0) {
    ledger.within(Check::total_mass, deviation, bound, scale, 3.0 + deviation, 3.0);
    return result.rows[0].holds;
  }
};

TEST(ConservationLedger, AcceptsHalfABoundAndRefusesThree) {
  EXPECT_TRUE(OneCheck().within(0.5e-12, 1e-12));
  EXPECT_FALSE(OneCheck().within(3e-12, 1e-12));
  EXPECT_FALSE(OneCheck().within(1.001e-12, 1e-12));
}

TEST(ConservationLedger, RefusesAnyDeviationFromWhatIsExact) {
  EXPECT_TRUE(OneCheck().within(0.0, 0.0));
  EXPECT_FALSE(OneCheck().within(1e-300, 0.0));
}

TEST(ConservationLedger, RefusesWhatIsNotANumber) {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(OneCheck().within(no_number, 1.0));
  EXPECT_FALSE(OneCheck().within(1.0, no_number));
}

TEST(ConservationLedger, NamesTheFirstThatDoesNotHold) {
  OneCheck check;
  check.within(0.5, 1.0);
  check.result.removals = 5;
  check.within(4.0, 1.0);
  check.within(9.0, 1.0);
  ASSERT_TRUE(check.ledger.broken());
  const std::string what = to_string(*check.result.violation);
  EXPECT_EQ(what, "after operation 5 of seed 7: total mass (relative): 7, expected 3 (bound: 1)");
  EXPECT_EQ(check.result.rows[0].checks, 3u);
}

TEST(ConservationLedger, KeepsTheCheckThatCameClosestAndTheLargestOfAll) {
  OneCheck check;
  check.within(2.0, 100.0, 2.0);  // large, far from its bound
  check.within(0.5, 1.0, 2.0);
  const ConservedRow& row = check.result.rows[0];
  EXPECT_EQ(row.largest, 1.0);
  EXPECT_EQ(row.deviation, 0.25);
  EXPECT_EQ(row.bound, 0.5);
}

TEST(ConservationLedger, RefusesOtherBits) {
  ConservationResult result;
  ConservationLedger ledger(result, 1, std::array{Check::counts, Check::valid});
  ledger.equal(Check::counts, 5, 5, "dimension", 0);
  ledger.require(Check::valid, true, "vertex", 3);
  EXPECT_FALSE(ledger.broken());
  ledger.equal(Check::counts, 5, 6, "dimension", 1);
  ledger.require(Check::valid, false, "vertex", 3);
  EXPECT_FALSE(result.rows[0].holds);
  EXPECT_FALSE(result.rows[1].holds);
  EXPECT_EQ(result.violation->what, "vertices, edges, faces, volumes, dimension 1");
}

// The table at the top of conserved_sums.h, for six cells around a vertex, and 4 for the sums themselves.
TEST(ChangeBound, IsTheSumOfTheRoundingsOfItsDerivation) {
  TwofoldSum one;
  one.add(-1.0);
  const std::pair<Conserved, int> roundings[]{
      {Conserved::mass, 5},      {Conserved::momentum_x, 6}, {Conserved::momentum_y, 6}, {Conserved::momentum_z, 6},
      {Conserved::spin_x, 8},    {Conserved::spin_y, 8},     {Conserved::spin_z, 8},     {Conserved::kinetic, 9},
      {Conserved::stiffness, 1}, {Conserved::damping, 1},    {Conserved::elastic, 2},    {Conserved::boundary, 0}};
  EXPECT_EQ(std::size(roundings), conserved_count);
  for (const auto& [c, n] : roundings) {
    const double expected = 1.001 * (n + 4) * u * 3.0;
    EXPECT_NEAR(change_bound(c, 6, one, one, one), expected, 1e-12 * expected) << static_cast<int>(c);
    EXPECT_NEAR(change_bound(c, 6, one, one, {}, 2) / (1.001 * (n + 6) * u * 2.0), 1.0, 1e-12) << static_cast<int>(c);
  }
}

TEST(ConservedSumsOfAVertex, AreItsMassMomentumSpinAndKineticEnergy) {
  ConservedSums sums;
  sums.add_node(2.0, {1, 2, 3}, {4, 5, 7});
  const std::pair<Conserved, double> expected[]{
      {Conserved::mass, 2},    {Conserved::momentum_x, 8}, {Conserved::momentum_y, 10}, {Conserved::momentum_z, 14},
      {Conserved::spin_x, -2}, {Conserved::spin_y, 10},    {Conserved::spin_z, -6},     {Conserved::kinetic, 90}};
  for (const auto& [c, value] : expected) EXPECT_EQ(sums[c].value(), value) << static_cast<int>(c);
  // terms that cancel in a spin count in its size: 2 (2 * 7 + 3 * 5)
  EXPECT_EQ(sums[Conserved::spin_x].magnitude, 58.0);
  sums.add_spring(8.0, 0.5, -0.25);
  EXPECT_EQ(sums[Conserved::stiffness].value(), 8.0);
  EXPECT_EQ(sums[Conserved::damping].value(), 0.5);
  EXPECT_EQ(sums[Conserved::elastic].value(), 0.25);
}

TEST(Drift, IsTheLargestDistanceFromWhatShouldBeLeft) {
  Drift drift;
  drift.begin(4.0);
  drift.remove(1.0);
  drift.compare(3.0);
  EXPECT_EQ(drift.largest(), 0.0);
  drift.compare(3.0 + 0x1p-40);
  drift.compare(3.0);
  EXPECT_EQ(drift.largest(), 0x1p-42);
}

TEST(Drift, MayGrowAsTheRootOfTheOperations) {
  EXPECT_DOUBLE_EQ(drift_target(0), 1e-15);
  EXPECT_DOUBLE_EQ(drift_target(1), 1e-15);
  EXPECT_DOUBLE_EQ(drift_target(10000), 1e-13);
}

}  // namespace
}  // namespace dartboard::conservation_bounds_test
