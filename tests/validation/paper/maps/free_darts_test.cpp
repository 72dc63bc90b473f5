#include "validation/paper/maps/free_darts.h"

#include <gtest/gtest.h>

#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::free_darts_test {
namespace {

TEST(FreeDarts, AreTheBoundary) {
  const ClaimAnswer answer = try_free_darts(kuhn_box(2, 2, 2, 1.0));
  expect_yes(answer);  // 24 squares of two triangles, of six darts each
  EXPECT_EQ(answer.measured, "288 free darts on 48 of 48 sides; closed surfaces: none");
}

TEST(FreeDarts, AreNotWhereAnInnerFaceIsFree) {
  const Mesh mesh = kuhn_box(2, 2, 2, 1.0);
  auto built = build_map<Map3>(mesh);
  expect_yes(free_darts_are_boundary(built.map, built.point, mesh));
  Dart inner = no_dart;
  built.map.for_each_dart([&](Dart d) { inner = built.map.is_free<3>(d) ? inner : d; });
  dissociate_face(built.map, inner);
  expect_no(free_darts_are_boundary(built.map, built.point, mesh));
}

TEST(FreeDarts, AreNotWhereOneDartOfAFaceIs) {
  const Mesh mesh = kuhn_box(2, 2, 2, 1.0);
  auto built = build_map<Map3>(mesh);
  Dart inner = no_dart;
  built.map.for_each_dart([&](Dart d) { inner = built.map.is_free<3>(d) ? inner : d; });
  built.map.unlink<3>(inner);
  expect_no(free_darts_are_boundary(built.map, built.point, mesh));
}

TEST(FreeDarts, AreAllDartsOfASideOfTheBoundary) {
  const Mesh mesh = kuhn_box(2, 2, 2, 1.0);
  auto built = build_map<Map3>(mesh);
  std::vector<Dart> free;
  built.map.for_each_dart([&](Dart d) {
    if (built.map.is_free<3>(d)) free.push_back(d);
  });
  built.map.link<3>(free.front(), free.back());  // one dart each of two sides
  expect_no(free_darts_are_boundary(built.map, built.point, mesh));
}

TEST(FreeDarts, AreFreeForNothingElse) {
  const Mesh mesh = triangle_sheet(2, 2, 1.0);
  auto built = build_map<Map2>(mesh);
  expect_yes(free_darts_are_boundary(built.map, built.point, mesh));
  built.map.unlink<1>(Dart{0});
  expect_no(free_darts_are_boundary(built.map, built.point, mesh));
}

}  // namespace
}  // namespace dartboard::free_darts_test
