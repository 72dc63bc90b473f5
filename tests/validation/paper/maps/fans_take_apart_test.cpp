#include "validation/paper/maps/fans_take_apart.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::fans_take_apart_test {
namespace {

Mesh body() { return tetrahedron_ball(2, 1.0); }

TEST(FansTakeApart, TheirVertexAlwaysAndOneFaceSeldom) {
  const FanAnswers answers = try_fans(body());
  expect_yes(answers.one_face);
  expect_yes(answers.whole_fan);
  expect_yes(answers.ends);
}

TEST(FansTakeApart, NotWhereTheyAreOneFace) {
  const FanAnswers answers = try_fans(body(), [](const TetMap&, Dart d) { return std::vector<Dart>{d}; });
  expect_no(answers.whole_fan);
  expect_no(answers.ends);
}

TEST(FansTakeApart, NotWhereOneFaceIsLeftOut) {
  const FanAnswers answers = try_fans(body(), [](const TetMap& map, Dart d) {
    auto faces = core_fan()(map, d);
    if (faces.size() > 2) faces.pop_back();
    return faces;
  });
  expect_no(answers.whole_fan);
  expect_no(answers.ends);
}

// Faces too many still take the vertex apart.
TEST(FansTakeApart, EndNowhereElse) {
  const FanAnswers answers = try_fans(body(), [](const TetMap& map, Dart d) {
    auto faces = core_fan()(map, d);
    const Dart more = map.alpha<2>(d);
    if (!map.is_free<3>(more)) faces.push_back(more);
    return faces;
  });
  expect_yes(answers.whole_fan);
  expect_no(answers.ends);
}

// The only inner face of two tetrahedra takes all of its vertices apart, and no fan is closed.
TEST(FansTakeApart, IsNotSeldomOfOneFaceWhereItAlwaysIs) {
  const FanAnswers answers = try_fans(two_tetrahedra());
  expect_no(answers.one_face);
  EXPECT_TRUE(answers.one_face.measured.starts_with("1 of 1 inner faces")) << answers.one_face.measured;
  expect_yes(answers.whole_fan);
  expect_no(answers.ends);
}

}  // namespace
}  // namespace dartboard::fans_take_apart_test
