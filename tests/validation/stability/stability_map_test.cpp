// Small maps of stability: boundaries by runs where theory puts them, growth of the right sign on both sides.

#include "validation/stability/stability_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard::stability_map_test {
namespace {

StabilityMap small_map(const char* name) {
  for (const IntegratorEntry& entry : integrators())
    if (entry.name == name) return measure_stability_map(entry, map_plan(entry.make()->scheme(), true));
  return {};
}

TEST(StabilityMap, HasTheBoundaryOfTheory) {
  for (const IntegratorEntry& entry : integrators()) {
    const Scheme& scheme = entry.make()->scheme();
    if (scheme.implicit) continue;
    const StabilityMap map = measure_stability_map(entry, map_plan(scheme, true));
    EXPECT_FALSE(map.boundary.empty()) << entry.name;
    EXPECT_FALSE(map.theory.empty()) << entry.name;
    // the powers of the spectral radius leave out the contribution of inclined eigenvectors (scheme_test.cpp): 0.2 %
    for (const auto& c : map.boundary)
      EXPECT_LE(c.distance(), 2e-3) << entry.name << ", zeta " << c.zeta << ": " << c.measured << " for " << c.theory;
  }
}

TEST(StabilityMap, OfVerletGrowsBeyondTwoAndNowhereElse) {
  const StabilityMap map = small_map("verlet");
  ASSERT_EQ(map.growth.size(), map.theta.size() * map.zeta.size());
  for (std::size_t r = 0; r < map.zeta.size(); ++r)
    for (std::size_t c = 0; c < map.theta.size(); ++c) {
      const double growth = map.growth[r * map.theta.size() + c];
      // a neutral oscillation has a growth of up to 1e-2, since its periods are not whole
      if (map.theta[c] < 1.95) {
        EXPECT_LE(growth, 1e-2) << map.theta[c] << " " << map.zeta[r];
      }
      if (map.theta[c] > 2.05 && map.zeta[r] < 0.1) {
        EXPECT_GT(growth, 1e-2) << map.theta[c] << " " << map.zeta[r];
      }
    }
}

TEST(StabilityMap, BeginsWithNoDamping) {
  const StabilityMap map = small_map("rk4");
  EXPECT_EQ(map.zeta.front(), 0.0);
  EXPECT_DOUBLE_EQ(map.zeta.back(), 10.0);
  EXPECT_NEAR(map.boundary.front().theory, 2.83, 0.02);
}

}  // namespace
}  // namespace dartboard::stability_map_test
