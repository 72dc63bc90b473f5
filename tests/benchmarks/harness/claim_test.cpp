#include "benchmarks/harness/claim.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dartboard::claim_test {
namespace {

Claim claim_with(Verdict verdict, std::string reason = "") {
  return {"arrays", "cell arrays cost what plain arrays cost",
          "5.2",    "<= 1.10",
          "1.04",   "[1.02, 1.07] at 96.9 %",
          verdict,  std::move(reason)};
}

TEST(ClaimExitCode, IsZeroWhenEveryTestedClaimHolds) {
  EXPECT_EQ(exit_code({}), 0);
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::holds), claim_with(Verdict::not_tested)}), 0);
}

TEST(ClaimExitCode, IsZeroWhereWhatDoesNotCarryOverHasAReason) {
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::does_not_carry_over, "faster caches")}), 0);
  Claim known = claim_with(Verdict::does_not_carry_over, "faster caches");
  known.expected = Verdict::does_not_carry_over;
  EXPECT_EQ(exit_code(std::vector{known}), 0);
}

TEST(ClaimExitCode, IsOneWhereAnAnswerIsNotTheKnownOneAndNobodySaysWhy) {
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::holds), claim_with(Verdict::does_not_carry_over)}), 1);
  Claim holds_now = claim_with(Verdict::holds);
  holds_now.expected = Verdict::does_not_carry_over;
  EXPECT_EQ(exit_code(std::vector{holds_now}), 1);
  holds_now.reason = "another processor";
  EXPECT_EQ(exit_code(std::vector{holds_now}), 0);
}

TEST(ClaimExitCode, IsZeroWhateverWasExpectedOfWhatWasNotTested) {
  Claim untested = claim_with(Verdict::not_tested);
  untested.expected = Verdict::does_not_carry_over;
  EXPECT_EQ(exit_code(std::vector{untested}), 0);
}

TEST(ClaimExitCode, IsOneWhenAClaimFallsShortWhateverTheReason) {
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::falls_short, "a reason")}), 1);
}

TEST(ClaimExitCode, IsOneWhenAClaimFallsShort) {
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::holds), claim_with(Verdict::falls_short)}), 1);
}

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

Figure figure(double low, double median, double high) { return {median, {low, high, 0.98, true}}; }

TEST(Bound, IsMetByAWholeIntervalMissedByAWholeIntervalAndElseOpenWhereverTheMedianIs) {
  EXPECT_EQ(at_most(figure(0.8, 0.9, 0.95), 1.0), Met::yes);
  EXPECT_EQ(at_most(figure(0.8, 0.9, 1.0), 1.0), Met::yes);
  EXPECT_EQ(at_most(figure(0.8, 0.9, 1.01), 1.0), Met::open);
  EXPECT_EQ(at_most(figure(0.9, 1.1, 1.2), 1.0), Met::open);
  EXPECT_EQ(at_most(figure(1.0, 1.1, 1.2), 1.0), Met::open);
  EXPECT_EQ(at_most(figure(1.01, 1.1, 1.2), 1.0), Met::no);
  EXPECT_EQ(at_least(figure(1.1, 1.2, 1.3), 1.0), Met::yes);
  EXPECT_EQ(at_least(figure(1.0, 1.2, 1.3), 1.0), Met::yes);
  EXPECT_EQ(at_least(figure(0.99, 1.2, 1.3), 1.0), Met::open);
  EXPECT_EQ(at_least(figure(0.7, 0.9, 1.1), 1.0), Met::open);
  EXPECT_EQ(at_least(figure(0.7, 0.9, 1.0), 1.0), Met::open);
  EXPECT_EQ(at_least(figure(0.7, 0.9, 0.99), 1.0), Met::no);
}

// One process has an interval of zero width: it would decide everything.
TEST(Bound, IsOpenWhereTheIntervalRestsOnTooFewValues) {
  Figure few = figure(0.5, 0.5, 0.5);
  few.interval.reached = false;
  for (const double bound : {0.4, 0.5, 0.6}) {
    EXPECT_EQ(at_most(few, bound), Met::open);
    EXPECT_EQ(at_least(few, bound), Met::open);
  }
}

TEST(Bound, IsNotMetByWhatIsNotANumber) {
  for (const Figure& f : {figure(nan_value, 0.5, 0.6), figure(0.4, nan_value, 0.6), figure(0.4, 0.5, nan_value)}) {
    EXPECT_EQ(at_most(f, 1.0), Met::no);
    EXPECT_EQ(at_least(f, 0.1), Met::no);
  }
}

TEST(Judge, LetsNothingFallShortThatIsOpenAndSaysSo) {
  Claim claim = claim_with(Verdict::holds);
  judge(claim, Met::yes);
  EXPECT_EQ(claim.verdict, Verdict::holds);
  EXPECT_EQ(claim.reason, "");
  judge(claim, Met::no);
  EXPECT_EQ(claim.verdict, Verdict::falls_short);
  judge(claim, Met::open);
  EXPECT_EQ(claim.verdict, Verdict::undecided);
  EXPECT_NE(claim.reason.find("cannot decide"), std::string::npos) << claim.reason;
}

TEST(Judge, GivesTheCauseToAClaimThatFallsShortAndToNoOther) {
  const auto reason = [](Met met) { return target("id", "text", "<= 1", "2", "[1, 3]", met, "a cause").reason; };
  EXPECT_EQ(reason(Met::no), "a cause");
  EXPECT_EQ(reason(Met::yes), "");
  EXPECT_NE(reason(Met::open), "a cause") << "an open one has a reason of its own";
  Claim claim{.reason = "known before"};
  judge(claim, Met::no);
  EXPECT_EQ(claim.reason, "known before");
}

TEST(Claims, AreToldInWords) {
  std::vector<Claim> claims(4, claim_with(Verdict::holds));
  EXPECT_EQ(in_words(claims), "4 claims hold.");
  claims[1].verdict = Verdict::does_not_carry_over;
  claims[1].id = "ladder";
  claims[1].reason = "faster caches";
  claims[2].verdict = Verdict::not_tested;
  claims[2].id = "fan";
  EXPECT_EQ(in_words(claims),
            "2 claims hold; 1 of the paper's does not carry over to this machine (ladder); 1 was not tested (fan).");
  claims[3].verdict = Verdict::undecided;
  EXPECT_NE(in_words(claims).find("; 1 is undecided (arrays); 1 was not tested (fan)."), std::string::npos);
  claims[3].verdict = Verdict::falls_short;
  claims[2].verdict = Verdict::falls_short;
  EXPECT_EQ(
      in_words(claims),
      "1 claim holds; 2 fall short (fan, arrays); 1 of the paper's does not carry over to this machine (ladder).");
  claims[1].reason.clear();
  EXPECT_NE(in_words(claims).find("1 has another answer than the known one, and no reason is known (ladder)"),
            std::string::npos);
}

TEST(Claim, NamesWhatIsExpectedInJsonWhereThatIsNotThatItHolds) {
  Claim claim = claim_with(Verdict::does_not_carry_over, "faster caches");
  EXPECT_FALSE(nlohmann::json(claim).contains("expected"));
  claim.expected = Verdict::does_not_carry_over;
  EXPECT_EQ(nlohmann::json(claim).at("expected"), "does not carry over");
  EXPECT_EQ(nlohmann::json(claim).at("verdict"), "does not carry over");
}

TEST(Claim, NamesItsVerdictInJson) {
  const nlohmann::json json = claim_with(Verdict::falls_short, "larger caches");
  EXPECT_EQ(json.at("id"), "arrays");
  EXPECT_EQ(json.at("section"), "5.2");
  EXPECT_EQ(json.at("paper"), "<= 1.10");
  EXPECT_EQ(json.at("measured"), "1.04");
  EXPECT_EQ(json.at("verdict"), "falls short");
  EXPECT_EQ(json.at("reason"), "larger caches");
}

TEST(Claim, LeavesOutAnEmptyReason) {
  EXPECT_FALSE(nlohmann::json(claim_with(Verdict::holds)).contains("reason"));
  EXPECT_EQ(table_of(std::vector{claim_with(Verdict::holds)}).columns().size(), 6u);
}

TEST(Claim, TableGainsAColumnWhenThereIsAReason) {
  const Table table = table_of(std::vector{claim_with(Verdict::holds), claim_with(Verdict::not_tested, "a quick run")});
  ASSERT_EQ(table.columns().size(), 7u);
  EXPECT_EQ(table.rows()[0].back(), "");
  EXPECT_EQ(table.rows()[1].back(), "a quick run");
}

TEST(Claim, TableHeadsTargetsOfOurOwnAsTargetsAndThePapersAsThePapers) {
  const auto heads = [](const std::vector<Claim>& claims) {
    std::vector<std::string> names;
    const Table table = table_of(claims);
    for (const Column& column : table.columns()) names.push_back(column.title);
    return names;
  };
  const Claim papers = claim_with(Verdict::holds);
  Claim ours = papers;
  ours.section.clear();
  using Names = std::vector<std::string>;
  EXPECT_EQ(heads({ours}), (Names{"claim", "target", "measured", "interval or bound", "verdict"}));
  EXPECT_EQ(heads({papers}), (Names{"claim", "section", "paper", "measured", "interval or bound", "verdict"}));
  EXPECT_EQ(heads({papers, ours}),
            (Names{"claim", "section", "paper, or target", "measured", "interval or bound", "verdict"}));
  EXPECT_EQ(table_of(std::vector{ours}).rows()[0][1], "<= 1.10");
}

TEST(Claim, AsTextHasTheVerdictFirstAndWhatItRestsOnBelow) {
  const Claim claim{"a", "arrays are fast", "5.2", "<= 1.10", "1.04", "[1.02, 1.07]", Verdict::holds, ""};
  EXPECT_EQ(to_text(std::span(&claim, 1)),
            "holds         arrays are fast (section 5.2)\n"
            "              paper: <= 1.10; here: 1.04; [1.02, 1.07]\n");
}

TEST(Claim, AsTextIsAlignedWithTheLongestVerdict) {
  std::vector<Claim> claims{{.id = "a", .text = "arrays are fast", .verdict = Verdict::does_not_carry_over},
                            {.id = "b", .text = "lists are slow", .verdict = Verdict::holds}};
  EXPECT_EQ(to_text(claims),
            "does not carry over  arrays are fast\n"
            "holds                lists are slow\n");
}

}  // namespace
}  // namespace dartboard::claim_test
