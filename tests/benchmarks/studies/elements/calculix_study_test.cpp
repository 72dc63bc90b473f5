#include "benchmarks/studies/elements/calculix_study.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/studies/elements/elements_study.h"
#include "core/plain/error.h"

namespace dartboard::calculix_study_test {
namespace {

/// Displacements as CalculiX prints them, each times `factor`.
std::string printed(const CalculixQuestion& question, double factor) {
  std::string text = "\n displacements (vx,vy,vz) for set ALL and time  0.1000000E+01\n\n";
  for (std::size_t i = 0; i < question.ours.size(); ++i) {
    const Eigen::Vector3d u = factor * question.ours[i];
    text += fmt::format("{:10} {:13.6E} {:13.6E} {:13.6E}\n", i + 1, u[0], u[1], u[2]);
  }
  return text;
}
std::vector<Verdict> verdicts(std::span<const CalculixAnswer> answers) {
  std::vector<Verdict> all;
  for (const Claim& claim : claims_of(answers)) all.push_back(claim.verdict);
  return all;
}
constexpr Verdict yes = Verdict::holds, no = Verdict::falls_short;

// One question at a time is answered wrongly; seven digits are right. A factor of 1 + 1e-5 is ten and five bounds.
TEST(CalculixStudy, SaysNoWhereDisplacementsAreOffByAHundredThousandth) {
  const std::vector<CalculixQuestion> questions = calculix_questions(2);
  ASSERT_EQ(questions.size(), 5u);
  const auto answers = [&](std::size_t wrong) {
    std::vector<CalculixAnswer> all;
    for (std::size_t k = 0; k < questions.size(); ++k)
      all.push_back(answer_to(questions[k], printed(questions[k], k == wrong ? 1.0 + 1e-5 : 1.0)));
    return all;
  };
  EXPECT_EQ(verdicts(answers(9)), (std::vector{yes, yes}));
  for (std::size_t k = 0; k < questions.size(); ++k)
    EXPECT_EQ(verdicts(answers(k)), questions[k].large ? (std::vector{yes, no}) : (std::vector{no, yes})) << k;
  for (const CalculixAnswer& a : answers(9)) {
    EXPECT_LT(a.apart, 5e-7) << a.what;
    EXPECT_NEAR(a.largest, a.large ? 0.59 : 0.0007, a.large ? 0.03 : 0.0004) << a.what;
  }
}

TEST(CalculixStudy, SaysNoWhereNothingOrNoNumberIsAnswered) {
  EXPECT_EQ(verdicts({}), (std::vector{no, no}));
  const CalculixAnswer small{"a", false, 9, 0.001, 1e-7}, large{"b", true, 9, 0.6, 1e-7};
  EXPECT_EQ(verdicts(std::vector{small, large}), (std::vector{yes, yes}));
  EXPECT_EQ(verdicts(std::vector{small}), (std::vector{yes, no}));
  CalculixAnswer none = large;
  none.apart = NAN;
  EXPECT_EQ(verdicts(std::vector{none, small, large}), (std::vector{yes, no}));
}

TEST(CalculixStudy, SaysNoWhereLargeDisplacementsAreSmall) {
  const CalculixAnswer small{"a", false, 9, 0.001, 1e-7}, large{"b", true, 9, 0.4, 1e-7};
  EXPECT_EQ(verdicts(std::vector{small, large}), (std::vector{yes, no}));
  EXPECT_EQ(claims_of(std::vector{small, large})[1].reason, "a beam of 1 m is bent by 0.40 m only");
}

TEST(CalculixStudy, TellsHowFarEachBeamIsApart) {
  EXPECT_EQ(calculix_table(std::vector<CalculixAnswer>{{"a beam", true, 99, 0.60974, 1.24e-7}}).rows()[0],
            (std::vector<std::string>{"a beam", "99", "0.61", "1.2e-07"}));
}

}  // namespace
}  // namespace dartboard::calculix_study_test
