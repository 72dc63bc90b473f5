#include "validation/paper/uncut_body.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::uncut_body_test {
namespace {

using Body = MassSpringBody<Map3, Held::by_every_dart>;

Body small_body() { return build_body<Map3, Held::by_every_dart>(small_tetrahedral_problem()); }

TEST(UncutBody, HasTheMassesAndStiffnessesOfItsCells) {
  expect_yes(masses_are_of_cells(small_body(), small_tetrahedral_problem()));
  expect_yes(stiffnesses_are_of_cells(small_body(), small_tetrahedral_problem()));
}

TEST(UncutBody, HasNotWhereMassGoesFromOneVertexToAnother) {
  Body body = small_body();
  body.vertices.mass[3] -= 1e-9;
  body.vertices.mass[7] += 1e-9;
  expect_no(masses_are_of_cells(body, small_tetrahedral_problem()));
}

TEST(UncutBody, HasNotWhereACellIsHeavierThanItsVolume) {
  Body body = small_body();
  body.cell_mass[5] *= 1.0 + 1e-12;
  expect_no(masses_are_of_cells(body, small_tetrahedral_problem()));
}

TEST(UncutBody, HasNotWhereStiffnessGoesFromOneEdgeToAnother) {
  Body body = small_body();
  body.springs.change(3, [](Spring& s) { s.stiffness += 48.0; });
  body.springs.change(9, [](Spring& s) { s.stiffness -= 48.0; });
  expect_no(stiffnesses_are_of_cells(body, small_tetrahedral_problem()));
}

}  // namespace
}  // namespace dartboard::uncut_body_test
