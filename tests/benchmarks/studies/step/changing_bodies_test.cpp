// Bodies that change in every step: the two ways to follow end in the same bits.

#include "benchmarks/studies/step/changing_bodies.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "benchmarks/studies/step/changing_report.h"
#include "benchmarks/studies/step/step_bodies.h"
#include "tests/support/claims_for_tests.h"

namespace dartboard::changing_bodies_test {
namespace {

ChangingCosts measured(const ChangingPlan& plan) {
  ChangingCosts c;
  compare_changing(plan, [&](const ChangingCounts& n) { c.bodies.push_back(n); });
  measure_changing(plan, [&](const Sample& s) { c.samples.push_back(s); });
  return c;
}

std::set<std::uint64_t> hashes(const ChangingCosts& c, const std::string& task) {
  std::set<std::uint64_t> found;
  for (const Sample& s : c.samples)
    if (s.task == task) found.insert(s.hash);
  return found;
}

TEST(ChangingBodies, AreThePapersAndBoxesInGridOrder) {
  EXPECT_EQ(changing_bodies(0), std::vector{paper_step_body(true)});
  EXPECT_EQ(changing_bodies(1'000'000), (std::vector{paper_step_body(true), step_box(10'000, false),
                                                     step_box(100'000, false), step_box(1'000'000, false)}));
}

TEST(ChangingBodies, EndInTheSameBitsHoweverTheirEndsAreFound) {
  const ChangingCosts c = measured({.largest = 0, .rounds = 2});
  ASSERT_EQ(c.bodies.size(), 1u);
  EXPECT_EQ(c.bodies[0].differing, 0u);
  EXPECT_EQ(c.samples.size(), 5u * 2);
  EXPECT_EQ(find_claim(claims_of(c), "step-changing-agreement").verdict, Verdict::holds);
}

// One face in a hundred may come apart, each with a step. A tetrahedron has four, shared by two but on the boundary.
TEST(ChangingBodies, LoseOneFaceInAHundred) {
  std::vector<ChangingCounts> counts;
  compare_changing({.largest = 0}, [&](const ChangingCounts& n) { counts.push_back(n); });
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_LT(counts[0].faces, 2u * 1856 / 100);
  EXPECT_GT(counts[0].faces, 2u * 1856 / 120);
  EXPECT_EQ(counts[0].steps, static_cast<int>(counts[0].faces));
}

TEST(ChangingBodies, AreMadeAnewForEachSampleWhereTheyAreSmall) {
  ChangingCosts c;
  measure_changing({.largest = 10'000, .rounds = 2}, [&](const Sample& s) { c.samples.push_back(s); });
  EXPECT_EQ(hashes(c, step_box(10'000, false) + changing_task::followed).size(), 1u);
}

TEST(ChangingBodies, LoseOtherFacesInEachSampleWhereTheyAreLarge) {
  ChangingCosts c;
  measure_changing({.largest = 10'000, .rounds = 2, .most_made_anew = 5'000},
                   [&](const Sample& s) { c.samples.push_back(s); });
  const std::string box = step_box(10'000, false);
  EXPECT_EQ(hashes(c, box + changing_task::followed).size(), 2u);
  EXPECT_EQ(hashes(c, box + changing_task::followed), hashes(c, box + changing_task::all_anew));
}

TEST(ChangingBodies, MoveInAnotherWayThanTheGraph) {
  const ChangingCosts c = measured({.largest = 0, .rounds = 1});
  const std::string body = paper_step_body(true);
  EXPECT_NE(hashes(c, body + changing_task::followed), hashes(c, body + changing_task::alone));
}

}  // namespace
}  // namespace dartboard::changing_bodies_test
