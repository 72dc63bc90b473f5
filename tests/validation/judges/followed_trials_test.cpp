// Verdicts on wrong integrators by following a recommendation.

#include "validation/judges/followed_trials.h"

#include <gtest/gtest.h>

#include "tests/support/ticking_clock_for_tests.h"

namespace dartboard::followed_trials_test {
namespace {

// An undamped chain along its line: without dampers there is nothing to lose, and springs pull as their linearisation.
TEST(FollowedTrial, SeesWrongIntegratorsWhoseRunMissesTheError) {
  const TradeoffScene chain = chain_scene(8, 64.0);
  std::vector<IntegratorEntry> methods;
  for (const IntegratorEntry& entry : integrators())
    if (entry.name == "verlet" || entry.name == "rk4") methods.push_back(entry);
  for (const JudgeTrial& trial : try_followed(chain, reference_of(chain, ticking()), methods, 1e-5, ticking())) {
    EXPECT_EQ(trial.judge, "recommend --verify");
    EXPECT_EQ(trial.right, 2u);
    const bool harmless = trial.kind == Wrong::loses_damping || trial.kind == Wrong::as_if_unstretched;
    EXPECT_EQ(trial.same, harmless ? 2u : 0u) << static_cast<int>(trial.kind);
    EXPECT_EQ(trial.seen, harmless ? 0u : 2u) << static_cast<int>(trial.kind);
    EXPECT_TRUE(trial.unseen.empty()) << trial.unseen[0];
  }
}

}  // namespace
}  // namespace dartboard::followed_trials_test
