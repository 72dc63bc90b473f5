#include "validation/paper/pinched_vertex.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::pinched_vertex_test {
namespace {

TEST(PinchedVertex, IsAQuasiManifoldThatMoves) {
  const ClaimAnswer answer = try_pinched_vertex(kuhn_box(2, 2, 2, 0.1), pinched_body(3));
  expect_yes(answer);
  EXPECT_TRUE(answer.measured.starts_with("links of Euler characteristic 1 to 2, and 0 to 1")) << answer.measured;
}

TEST(PinchedVertex, IsNoneInAManifold) {
  expect_no(try_pinched_vertex(kuhn_box(2, 2, 2, 0.1), kuhn_box(2, 2, 2, 0.1)));
  expect_no(try_pinched_vertex(pinched_body(3), pinched_body(4)));
}

}  // namespace
}  // namespace dartboard::pinched_vertex_test
