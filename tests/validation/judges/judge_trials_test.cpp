#include "validation/judges/judge_trials.h"

#include <gtest/gtest.h>

#include <limits>

#include "validation/extremes/extreme_run.h"

namespace dartboard::judge_trials_test {
namespace {

ExtremeCell ended(std::vector<double> end, std::uint64_t steps = 100) {
  ExtremeCell cell;
  cell.end = std::move(end);
  cell.step = steps;
  return cell;
}

// One rounding a step, of the largest position and of the largest velocity.
TEST(SameButForRounding, AllowsARoundingInEachStep) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  const ExtremeCell run = ended({1.0, 2.0, 0.25, 0.5});
  EXPECT_TRUE(same_but_for_rounding(run, ended({1.0 + 200 * epsilon, 2.0, 0.25, 0.5})));
  EXPECT_FALSE(same_but_for_rounding(run, ended({1.0 + 220 * epsilon, 2.0, 0.25, 0.5})));
  EXPECT_FALSE(same_but_for_rounding(run, ended({1.0, 2.0, 0.25 + 60 * epsilon, 0.5})));
  EXPECT_FALSE(same_but_for_rounding(run, ended({})));
  EXPECT_FALSE(same_but_for_rounding(run, ended({1.0, 2.0, 0.25, std::numeric_limits<double>::quiet_NaN()})));
}

ExtremeCase case_of(const char* scene, const char* integrator, double theta) {
  return {
      "axis", scene, integrator, "value", [=](const MakeIntegrator& make) {
        return run_extreme({"axis", scene, integrator, "value", {}}, with_theta(moving_body(scene), theta, 40), make);
      }};
}

TEST(ExtremesTrial, SeesWhatIsWrongAndSaysWhereItMakesNoDifference) {
  ExtremesTrial trial;
  trial.take(case_of("chain", "rk4", 0.3));
  for (const JudgeTrial& t : trial.trials()) {
    EXPECT_EQ(t.judge, "extremes");
    EXPECT_EQ(t.part, "axis");
    EXPECT_EQ(t.right, 1u);
    // nothing is damped, and springs along a line are linear
    const bool same = t.kind == Wrong::loses_damping || t.kind == Wrong::as_if_unstretched;
    EXPECT_EQ(t.same, same ? 1u : 0u) << static_cast<int>(t.kind);
    EXPECT_EQ(t.seen, same ? 0u : 1u) << static_cast<int>(t.kind);
    EXPECT_TRUE(t.unseen.empty());
  }
  ASSERT_EQ(trial.slack().size(), 1u);
  EXPECT_EQ(trial.slack()[0].integrator, "rk4");
  EXPECT_GT(trial.slack()[0].worst, 0.0);
  EXPECT_LT(trial.slack()[0].worst, 1.0);
}

// Steps of 1e-6 / omega by backward Euler, to the tolerance of its solver: springs as if unstretched are within that.
TEST(ExtremesTrial, NamesWhatItDoesNotSee) {
  ExtremesTrial trial;
  trial.take(case_of("box", "backward-euler", 1e-6));
  const JudgeTrial t = trial.trials()[static_cast<std::size_t>(Wrong::as_if_unstretched)];
  EXPECT_EQ(t.kind, Wrong::as_if_unstretched);
  EXPECT_EQ(t.same, 0u);
  EXPECT_EQ(t.seen, 0u);
  ASSERT_EQ(t.unseen.size(), 1u);
  EXPECT_EQ(t.unseen[0].substr(0, 28), "box, backward-euler, value: ");
}

TEST(ExtremesTrial, AsksNothingWhereTheSoundRunIsNotCalledRight) {
  ExtremesTrial trial;
  trial.take(case_of("chain", "rk4", 30.0));  // unstable
  for (const JudgeTrial& t : trial.trials()) EXPECT_EQ(t.right, 0u);
  EXPECT_EQ(trial.slack()[0].runs, 1u);
}

// Lost damping shows where there is some; what is right near rest is right on a line.
TEST(ExactMaps, SeeAllThatChangesALinearOscillation) {
  for (const double zeta : {0.0, 1e-5})
    for (const JudgeTrial& t : try_exact_maps(zeta, 500)) {
      EXPECT_GT(t.right, 10u);
      const bool blind = t.kind == Wrong::as_if_unstretched || (t.kind == Wrong::loses_damping && zeta == 0.0);
      EXPECT_EQ(t.seen, blind ? 0u : t.right) << static_cast<int>(t.kind) << " " << zeta;
      EXPECT_EQ(t.same, blind ? t.right : 0u) << static_cast<int>(t.kind) << " " << zeta;
    }
}

TEST(TryOrder, SeesWrongIntegratorsInTheOrdersThatTheyShow) {
  std::vector<IntegratorEntry> methods;
  for (const IntegratorEntry& entry : integrators())
    if (entry.name == "verlet" || entry.name == "rk4") methods.push_back(entry);
  for (const JudgeTrial& t :
       try_order(order_stage(OrderCase::undamped), methods, {.most_error = 0.05, .most_steps = 24 << 6})) {
    EXPECT_EQ(t.right, 2u);
    EXPECT_EQ(t.seen, t.kind == Wrong::loses_damping ? 0u : 2u) << static_cast<int>(t.kind);
    EXPECT_EQ(t.same, t.kind == Wrong::loses_damping ? 2u : 0u) << static_cast<int>(t.kind);
  }
}

}  // namespace
}  // namespace dartboard::judge_trials_test
