#include "validation/paper/indexed_structure.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::indexed_structure_test {
namespace {

TEST(IndexedStructure, FollowsEveryOperation) { expect_yes(translate_operations(small_tetrahedral_problem(), 80, 2)); }

TEST(IndexedStructure, IsNotRightWhereOneChangeIsNotTranslated) {
  int changes = 0;
  expect_no(translate_operations(small_tetrahedral_problem(), 80, 2,
                                 [&](LiveBody<Map3>& body, Views& views, const TopologyChange& change) {
                                   Followed followed{adapt(body, change), {}};
                                   if (++changes != 20) views.apply(body, change, followed.embeddings);
                                   return followed;
                                 }));
}

TEST(IndexedStructure, IsNotRightWhereASpringEndsElsewhere) {
  const ClaimAnswer answer = translate_operations(small_tetrahedral_problem(), 80, 2,
                                                  [](LiveBody<Map3>& body, Views& views, const TopologyChange& change) {
                                                    Followed followed = follow(body, views, change);
                                                    std::swap(views.ends.ends[0][0], views.ends.ends[1][0]);
                                                    return followed;
                                                  });
  expect_no(answer);
  EXPECT_TRUE(answer.measured.starts_with("operation 0: ends of springs")) << answer.measured;
}

TEST(IndexedStructure, IsNotRightWhereASpringKeepsItsStiffness) {
  expect_no(translate_operations(small_tetrahedral_problem(), 80, 2,
                                 [](LiveBody<Map3>& body, Views& views, const TopologyChange& change) {
                                   const double k = body.springs[0].stiffness;
                                   Followed followed = follow(body, views, change);
                                   body.springs.change(0, [&](Spring& s) { s.stiffness = k; });
                                   return followed;
                                 }));
}

}  // namespace
}  // namespace dartboard::indexed_structure_test
