#include "benchmarks/studies/elements/operated_study.h"

#include <gtest/gtest.h>

#include <limits>

namespace dartboard::operated_study_test {
namespace {

OperatedBody sound() {
  OperatedBody body{"a body", 48, {}};
  body.found = {.model = "stvk",
                .dissociated = 90,
                .removed = 10,
                .compared = 5,
                .dissociation = 0.0,
                .removal = 1e-15,
                .energy = 2e-15,
                .force = 3e-15,
                .mass = 4e-16};
  return body;
}
std::vector<Verdict> verdicts(const OperatedBody& body) {
  std::vector<Verdict> all;
  for (const Claim& claim : claims_of(std::vector{sound(), body})) all.push_back(claim.verdict);
  return all;
}
constexpr Verdict yes = Verdict::holds, no = Verdict::falls_short;

TEST(OperatedStudy, HoldsWhereDifferencesAreRounding) {
  EXPECT_EQ(verdicts(sound()), (std::vector{yes, yes, yes, yes}));
}

TEST(OperatedStudy, FallsShortOfAnyDifferenceOfAnyBody) {
  for (const double wrong : {1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    OperatedBody body = sound();
    body.found.dissociation = wrong;
    EXPECT_EQ(verdicts(body), (std::vector{no, yes, yes, yes}));
    body = sound();
    body.found.removal = wrong;
    EXPECT_EQ(verdicts(body), (std::vector{yes, no, yes, yes}));
    for (const auto member : {&ElementOperations::energy, &ElementOperations::force, &ElementOperations::mass}) {
      body = sound();
      body.found.*member = wrong;
      EXPECT_EQ(verdicts(body), (std::vector{yes, yes, no, yes}));
    }
  }
  for (const Claim& claim : claims_of(std::vector<OperatedBody>{})) EXPECT_EQ(claim.verdict, no);
}

TEST(OperatedStudy, FallsShortOfOneCellThatIsNotItsOwn) {
  OperatedBody body = sound();
  body.found.strangers = 1;
  EXPECT_EQ(verdicts(body), (std::vector{yes, yes, yes, no}));
}

TEST(OperatedStudy, TellsWhatWasDoneToEachBody) {
  EXPECT_EQ(operations_table({sound()}).rows()[0],
            (std::vector<std::string>{"a body", "48", "stvk", "90", "10", "0.0e+00", "1.0e-15", "5", "2.0e-15",
                                      "3.0e-15", "4.0e-16"}));
}

}  // namespace
}  // namespace dartboard::operated_study_test
