#include "benchmarks/studies/reproduce/paper_answers.h"

#include <gtest/gtest.h>

#include <set>

#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/paper/paper_claims.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/reproduce/reproduce_report.h"
#include "tests/support/claims_for_tests.h"

namespace dartboard::paper_answers_test {
namespace {

TEST(PaperAnswers, HoldOnThePapersBodyButForWhatWasSaidToBeImpossible) {
  const std::vector<Claim> claims = answer_by_trials(paper_body("liver").make());
  EXPECT_EQ(ids_of(claims, Verdict::does_not_carry_over), std::vector<std::string>{"sews-translated"});
  EXPECT_EQ(ids_of(claims, Verdict::holds).size() + 1, claims.size());
  EXPECT_EQ(exit_code(claims), 0);
  for (const Claim& claim : claims) EXPECT_FALSE(claim.bound_or_interval.empty()) << claim.id;
}

TEST(PaperAnswers, FallShortWhereATrialDoes) {
  const Claim claim = tried_out("mass-split", {false, "m1 + m2 off"}, "here");
  EXPECT_EQ(claim.verdict, Verdict::falls_short);
  EXPECT_EQ(claim.measured, "m1 + m2 off");
  EXPECT_EQ(claim.bound_or_interval, "here");
}

// The arrays do not follow after all: news, and a failure of the program.
TEST(PaperAnswers, AreNewsWhereWhatWasDoneBeforeIsImpossibleNow) {
  const Claim done = tried_out("sews-translated", {true, ""}, ""),
              failed = tried_out("sews-translated", {false, ""}, "");
  EXPECT_EQ(done.verdict, Verdict::does_not_carry_over);
  EXPECT_EQ(exit_code(std::span(&done, 1)), 0);
  EXPECT_EQ(failed.verdict, Verdict::holds);
  EXPECT_EQ(exit_code(std::span(&failed, 1)), 1);
}

// Every sentence of the table has one answer.
TEST(PaperAnswers, AreGivenToAllSentencesInTheOrderOfThePaper) {
  Problem problem = paper_body("liver").make();
  ReproduceResults results;
  results.quick = true;
  results.counts = {{"darts", 44544, 44544}, {"vertices", 564, 564}, {"edges", 2850, 2850}, {"volumes", 1856, 1856}};
  StudyLog log;
  std::vector<std::string> asked, answered;
  for (const PaperClaim& row : paper_claims) asked.emplace_back(row.id);
  for (const Claim& claim : answer_claims(results, problem, log)) answered.push_back(claim.id);
  EXPECT_EQ(answered, asked);
}

}  // namespace
}  // namespace dartboard::paper_answers_test
