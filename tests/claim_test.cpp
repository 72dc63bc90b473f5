#include "benchmarks/claim.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace dartboard {
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

TEST(ClaimExitCode, IsOneWhenAClaimFallsShort) {
  EXPECT_EQ(exit_code(std::vector{claim_with(Verdict::holds), claim_with(Verdict::falls_short)}), 1);
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

}  // namespace
}  // namespace dartboard
