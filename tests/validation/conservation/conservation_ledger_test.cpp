// The ledger of the conservation runs keeps NaN, and reports that it breaks its bound.

#include "validation/conservation/conservation_ledger.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "validation/conservation/conserved_sums.h"

namespace dartboard::conservation_ledger_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array checks{Check::total_mass};

TEST(ConservationLedger, HoldsUpToTheBound) {
  ConservationResult result;
  ConservationLedger ledger(result, 1, checks);
  ledger.within(Check::total_mass, 1e-16, 2e-16, 1.0, 1.0, 1.0);
  ledger.within(Check::total_mass, 2e-16, 2e-16, 1.0, 1.0, 1.0);
  EXPECT_FALSE(ledger.broken());
  EXPECT_EQ(result.rows[0].largest, 2e-16);
  ledger.within(Check::total_mass, 2.1e-16, 2e-16, 1.0, 1.0, 1.0);
  EXPECT_TRUE(ledger.broken());
}

TEST(ConservationLedger, KeepsADeviationThatIsNoNumber) {
  ConservationResult result;
  ConservationLedger ledger(result, 1, checks);
  ledger.within(Check::total_mass, 1e-16, 2e-16, 1.0, 1.0, 1.0);
  ledger.within(Check::total_mass, nan, 2e-16, 1.0, nan, 1.0);
  EXPECT_TRUE(ledger.broken());
  ledger.within(Check::total_mass, 1e-16, 2e-16, 1.0, 1.0, 1.0);
  EXPECT_TRUE(std::isnan(result.rows[0].largest));
  EXPECT_TRUE(std::isnan(result.rows[0].deviation));
}

TEST(Drift, IsTheFarthestFromWhatShouldBeLeft) {
  Drift drift;
  drift.begin(4.0);
  drift.remove(1.0);
  drift.compare(3.0);
  EXPECT_EQ(drift.largest(), 0.0);
  drift.compare(3.5);
  drift.compare(3.0);
  EXPECT_EQ(drift.largest(), 0.125);
}

TEST(Drift, KeepsATotalThatIsNoNumber) {
  Drift drift;
  drift.begin(4.0);
  drift.compare(nan);
  drift.compare(4.0);
  EXPECT_TRUE(std::isnan(drift.largest()));
}

}  // namespace
}  // namespace dartboard::conservation_ledger_test
