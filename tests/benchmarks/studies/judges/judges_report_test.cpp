#include "benchmarks/studies/judges/judges_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/exit_codes.h"

namespace dartboard::judges_report_test {
namespace {

using Row = std::vector<std::string>;

/// One axis of extremes, with `seen` of 20 cases seen for each way of being wrong and 5 in which it changes nothing.
JudgesResults results(std::size_t seen) {
  JudgesResults r;
  for (const WrongIntegrator& wrong : wrong_integrators())
    r.trials.push_back({.judge = "extremes", .part = "step", .kind = wrong.kind, .right = 25, .same = 5, .seen = seen});
  r.trials[1].unseen = {"box, rk4, 1: 0.5 of its bound"};
  r.slack = {{"rk4", 25, 0.05}, {"bdf2", 25, 0.5}};
  return r;
}

TEST(JudgesReport, HoldsWhereNineteenOfTwentyWrongIntegratorsAreSeen) {
  const std::vector<Claim> claims = claims_of(results(19));
  ASSERT_EQ(claims.size(), 2u);  // no claims on judges that did not run
  EXPECT_EQ(claims[0].id, "extremes-see-wrong-integrators");
  EXPECT_EQ(claims[0].verdict, Verdict::holds);
  EXPECT_EQ(claims[0].measured, "95.0 %");
  EXPECT_EQ(claims[0].bound_or_interval, "133 of 140; in 35 more being wrong changes nothing; least: 95.0 %, step");
  EXPECT_EQ(claims_of(results(18))[0].verdict, Verdict::falls_short);
  EXPECT_EQ(exit_code(claims_of(results(18))), 1);
}

TEST(JudgesReport, DoesNotTestAJudgeWhereBeingWrongChangedNothing) {
  JudgesResults nothing = results(0);
  for (JudgeTrial& trial : nothing.trials) trial.same = trial.right;
  const Claim claim = claims_of(nothing)[0];
  EXPECT_EQ(claim.verdict, Verdict::not_tested);
  EXPECT_FALSE(claim.reason.empty());
}

TEST(JudgesReport, FallsShortWhereASoundStepIsBeyondItsBoundOrABoundIsLoose) {
  const auto verdict = [](double share) {
    JudgesResults r = results(20);
    r.slack[0].worst = share;
    return claims_of(r).back().verdict;
  };
  EXPECT_EQ(verdict(0.99), Verdict::holds);
  EXPECT_EQ(verdict(0.011), Verdict::holds);
  EXPECT_EQ(verdict(1.01), Verdict::falls_short);
  EXPECT_EQ(verdict(0.009), Verdict::falls_short);
  EXPECT_EQ(verdict(0.0), Verdict::falls_short);
  EXPECT_EQ(verdict(std::numeric_limits<double>::quiet_NaN()), Verdict::falls_short);
}

TEST(JudgesReport, CountsWhatIsSeenOfWhatDiffers) {
  const Table trials = trials_table(results(19));
  ASSERT_EQ(trials.rows().size(), 1u);
  EXPECT_EQ(trials.rows()[0], (Row{"extremes", "step", "25", "19 of 20", "19 of 20", "19 of 20", "19 of 20", "19 of 20",
                                   "19 of 20", "19 of 20"}));
  JudgesResults none = results(0);
  none.trials[0].same = 25;
  EXPECT_EQ(trials_table(none).rows()[0][3], "-");
  const Table judges = judges_table(results(19));
  ASSERT_EQ(judges.rows().size(), 1u);
  EXPECT_EQ(judges.rows()[0][1], "95.0 %");
  EXPECT_EQ(judges.rows()[0][2], "140");
  EXPECT_EQ(judges.rows()[0][3], "35");
}

TEST(JudgesReport, NamesEveryCaseThatWasNotSeen) {
  const Table unseen = unseen_table(results(19));
  ASSERT_EQ(unseen.rows().size(), 1u);
  EXPECT_EQ(unseen.rows()[0], (Row{"extremes", "step", "half the force", "box, rk4, 1: 0.5 of its bound"}));
  const Table slack = slack_table(results(19));
  EXPECT_EQ(slack.rows()[0], (Row{"rk4", "25", "0.05", "20"}));
}

TEST(JudgesReport, HoldsEveryFigureAsJson) {
  const nlohmann::ordered_json json = to_json(results(19));
  EXPECT_EQ(json.at("trials").size(), wrong_integrators().size());
  EXPECT_EQ(json.at("trials").at(1), nlohmann::ordered_json::parse(R"({"judge": "extremes", "part": "step",
    "wrong": "half the force", "called_right": 25, "no_difference": 5, "seen": 19, "seen_by_scheme": 0,
    "unseen": ["box, rk4, 1: 0.5 of its bound"]})"));
  EXPECT_EQ(json.at("slack").at(0), nlohmann::ordered_json::parse(R"({"integrator": "rk4", "runs": 25,
    "largest_share": 0.05})"));
}

}  // namespace
}  // namespace dartboard::judges_report_test
