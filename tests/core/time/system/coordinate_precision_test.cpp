#include "core/time/system/coordinate_precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/bodies/element_body_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::coordinate_precision_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two springs of 1 m and of `length` in a row along y, from (0, y, 0).
SpringArrays row_from(double y, double length) {
  SpringArrays row;
  row.add_vertex(1.0, {0, y, 0});
  row.add_vertex(1.0, {0, y + 1, 0});
  row.add_vertex(1.0, {0, y + 1 + length, 0});
  row.add_spring(0, 1, 1.0, 1.0);
  row.add_spring(1, 2, 1.0, length);
  return row;
}

TEST(CoordinatePrecision, IsSaidToBeCoarseAboveAMillionthOfASpring) {
  const double edge = 1e-6 / epsilon;  // where a spring of 1 m begins to be affected
  SpringArrays below = row_from(0.99 * edge, 1.0), above = row_from(1.01 * edge, 1.0);
  EXPECT_FALSE(find_coarse_coordinate(below.system(), below.x));
  ASSERT_TRUE(find_coarse_coordinate(above.system(), above.x));
}

TEST(CoordinatePrecision, NamesTheVertexOfTheShortestSpringThere) {
  SpringArrays row = row_from(-1e10, 0.25);
  const auto found = find_coarse_coordinate(row.system(), row.x);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edge, 1u);
  EXPECT_EQ(found->vertex, 1u);  // the end farther from the origin
  EXPECT_EQ(found->axis, 1);
  EXPECT_EQ(found->coordinate, -1e10 + 1);
  EXPECT_EQ(found->length, 0.25);
  EXPECT_NEAR(found->relative, epsilon * 4e10, 1e-9 * epsilon * 4e10);
  const std::string text = to_string(*found);
  EXPECT_NE(text.find("y = -1e+10 m of vertex 1"), std::string::npos) << text;
  EXPECT_NE(text.find("move the body to the origin"), std::string::npos) << text;
}

// From 2 m to 3 m on an axis: a unit in the last place of 3 over a length of 1.
TEST(CoordinatePrecision, IsThatOfTheEndFartherFromTheOrigin) {
  for (const bool far_end_first : {false, true}) {
    SpringArrays pair;
    pair.add_vertex(1.0, {far_end_first ? -3.0 : 2.0, 0, 0});
    pair.add_vertex(1.0, {far_end_first ? -2.0 : 3.0, 0, 0});
    pair.add_spring(0, 1, 1.0, 1.0);
    const auto found = find_coarse_coordinate(pair.system(), pair.x, 0.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->relative, 3 * epsilon);
    EXPECT_EQ(found->vertex, far_end_first ? 0u : 1u);
    EXPECT_EQ(found->axis, 0);
    EXPECT_EQ(found->coordinate, far_end_first ? -3.0 : 3.0);
  }
}

// A crushed spring is measured by its rest length, a stretched one by its present length.
TEST(CoordinatePrecision, IsToldInUnitsOfTheLongerOfBothLengths) {
  for (const double rest : {0.25, 4.0}) {
    SpringArrays pair;
    pair.add_vertex(1.0, {0, 7, 0});
    pair.add_vertex(1.0, {0, 8, 0});
    pair.add_spring(0, 1, 1.0, rest);
    const auto found = find_coarse_coordinate(pair.system(), pair.x, 0.0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length, std::max(rest, 1.0));
    EXPECT_EQ(found->relative, epsilon * 8 / std::max(rest, 1.0));
  }
}

TEST(CoordinatePrecision, IsNotThatOfASpringWithoutLength) {
  SpringArrays row = row_from(1e10, 0.0);
  row.ends.erase(row.ends.begin());
  row.springs.erase(row.springs.begin());
  EXPECT_FALSE(find_coarse_coordinate(row.system(), row.x));
}

/// A cube of 0.5 m of six tetrahedra, `far` from the origin along z.
ElementBody cube_at(double far) {
  ElementBody cube(kuhn_box(1, 1, 1, 0.5), Model::stvk, 1e5, 0.3);
  for (Eigen::Vector3d& p : cube.x) p.z() += far;
  return cube;
}

TEST(CoordinatePrecision, IsThatOfTheShortestEdgeOfElements) {
  EXPECT_FALSE(find_coarse_coordinate(cube_at(0.0).system(), cube_at(0.0).x));
  const ElementBody cube = cube_at(1e10);
  const auto found = find_coarse_coordinate(cube.system(), cube.x);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edge, CoordinatePrecision::of_element);
  EXPECT_EQ(found->axis, 2);
  EXPECT_EQ(found->coordinate, 1e10 + 0.5);
  EXPECT_EQ(found->coordinate, cube.x[found->vertex].z());
  EXPECT_EQ(found->length, 0.5);
  EXPECT_NEAR(found->relative, epsilon * 2e10, 1e-9 * epsilon * 2e10);
  const std::string text = to_string(*found);
  EXPECT_NE(text.find("of the shortest edge of an element next to it (0.5 m); move the body to the origin"),
            std::string::npos)
      << text;
}

TEST(CoordinatePrecision, IsSaidToBeCoarseOfElementsWhereItIsOfSprings) {
  const double edge = 0.5 * 1e-6 / epsilon;
  const ElementBody below = cube_at(0.99 * edge), above = cube_at(1.01 * edge);
  EXPECT_FALSE(find_coarse_coordinate(below.system(), below.x));
  EXPECT_TRUE(find_coarse_coordinate(above.system(), above.x));
}

// Springs of 4 m at all vertices but the last, and at that one too.
TEST(CoordinatePrecision, IsThatOfSpringsWhereAllVerticesOfAnElementHaveSome) {
  const ElementBody cube = cube_at(1e11);
  SpringArrays springs;
  for (const Eigen::Vector3d& p : cube.x) springs.add_vertex(1.0, p);
  for (std::uint32_t i = 1; i + 1 < cube.x.size(); ++i) springs.add_spring(0, i, 1.0, 4.0);
  const auto length = [&] {
    SpringSystem system = springs.system();
    system.terms = cube.system().terms;
    return find_coarse_coordinate(system, cube.x).value().length;
  };
  EXPECT_EQ(length(), 0.5);
  springs.add_spring(0, static_cast<std::uint32_t>(cube.x.size()) - 1, 1.0, 4.0);
  EXPECT_EQ(length(), 4.0);
}

}  // namespace
}  // namespace dartboard::coordinate_precision_test
