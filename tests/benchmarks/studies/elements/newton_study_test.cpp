#include "benchmarks/studies/elements/newton_study.h"

#include <gtest/gtest.h>

namespace dartboard::newton_study_test {
namespace {

std::vector<NewtonRun> sound() {
  return {{100.0, std::string(NewtonRun::exact), 5, 0.35},     {100.0, std::string(NewtonRun::projected), 38, 0.35},
          {100.0, std::string(NewtonRun::warped), 30, 0.35},   {200.0, std::string(NewtonRun::exact), 6, 0.6},
          {200.0, std::string(NewtonRun::projected), 61, 0.6}, {200.0, std::string(NewtonRun::warped), {}, 0.0}};
}
Verdict verdict_with(std::size_t k, std::optional<std::size_t> iterations, double bent) {
  std::vector<NewtonRun> runs = sound();
  runs[k].iterations = iterations;
  runs[k].bent = bent;
  return claim_on(runs).verdict;
}

TEST(NewtonStudy, HoldsWhereTheExactTangentNeedsTheFewestIterations) {
  const Claim claim = claim_on(sound());
  EXPECT_EQ(claim.verdict, Verdict::holds);
  EXPECT_EQ(claim.measured, "5 against 30, 6 against none in 200");
  EXPECT_EQ(newton_table(sound()).rows()[0], (std::vector<std::string>{"100", "exact tangent", "5", "0.3500"}));
  EXPECT_EQ(newton_table(sound()).rows()[5], (std::vector<std::string>{"200", "warped stiffness", "none in 200", ""}));
}

TEST(NewtonStudy, FallsShortWhereTheExactTangentIsNoBetter) {
  EXPECT_EQ(verdict_with(2, 6, 0.35), Verdict::holds);
  EXPECT_EQ(verdict_with(2, 5, 0.35), Verdict::falls_short);
  EXPECT_EQ(verdict_with(5, 4, 0.6), Verdict::falls_short);
  EXPECT_EQ(verdict_with(4, 6, 0.6), Verdict::falls_short);
  EXPECT_EQ(verdict_with(3, {}, 0.0), Verdict::falls_short);
}

TEST(NewtonStudy, FallsShortWhereAnotherPlaceIsFound) {
  EXPECT_EQ(verdict_with(2, 30, 0.350001), Verdict::holds);
  EXPECT_EQ(verdict_with(2, 30, 0.3501), Verdict::falls_short);
}

TEST(NewtonStudy, FallsShortOfNothing) {
  EXPECT_EQ(claim_on({}).verdict, Verdict::falls_short);
  std::vector<NewtonRun> runs = sound();
  runs.pop_back();  // the warped stiffness of one load
  EXPECT_EQ(claim_on(runs).verdict, Verdict::falls_short);
  runs = {sound()[0], sound()[1]};
  EXPECT_EQ(claim_on(runs).verdict, Verdict::falls_short);
}

}  // namespace
}  // namespace dartboard::newton_study_test
