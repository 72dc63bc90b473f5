#include "validation/paper/embeddings_held.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::embeddings_held_test {
namespace {

using One = MassSpringBody<Map3, Held::by_one_dart>;
using Every = MassSpringBody<Map3, Held::by_every_dart>;

TEST(EmbeddingsHeld, ByOneDartOrAllGiveTheSame) { expect_yes(try_both_ways_to_hold(small_tetrahedral_problem(), 2)); }

TEST(EmbeddingsHeld, DoNotGiveTheSameWhereAStateIsOffByABit) {
  const Problem problem = small_tetrahedral_problem();
  Every every = build_body<Map3, Held::by_every_dart>(problem);
  every.vertices.position[3][1] += 0x1p-52;
  const ClaimAnswer answer = same_results(build_body<Map3, Held::by_one_dart>(problem), every, problem.h, 2);
  expect_no(answer);
  EXPECT_NE(answer.measured.find("NOT equal"), std::string::npos) << answer.measured;
}

TEST(EmbeddingsHeld, DoNotGiveTheSameWhereADartFindsAnotherEdge) {
  const Problem problem = small_tetrahedral_problem();
  One one = build_body<Map3, Held::by_one_dart>(problem);
  one.edge.attach(one.map, Edge{one.edge_dart[5]}, 6);
  expect_no(same_results(one, build_body<Map3, Held::by_every_dart>(problem), problem.h, 0));
}

TEST(EmbeddingsHeld, IsNotAnsweredByABodyThatDoesNotMove) {
  expect_no(try_both_ways_to_hold(small_tetrahedral_problem(), 0));
}

}  // namespace
}  // namespace dartboard::embeddings_held_test
