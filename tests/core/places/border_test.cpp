#include "core/places/border.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace dartboard::border_test {
namespace {

using Eigen::Vector3d;

TEST(Border, IsABillionthOfTheBodysDiagonalThick) {
  const std::vector<Vector3d> points{{-3, 0, 0}, {0, 4, 0}, {-1, 1, 12}};  // a box of 3 x 4 x 12: diagonal 13
  EXPECT_DOUBLE_EQ(border_thickness(points), 13e-9);
  EXPECT_EQ(border_thickness({}), 0.0);
}

TEST(Border, BelongsToTheInside) {
  EXPECT_TRUE(is_inside(-0.99e-9, 1.0, 1e-9));
  EXPECT_FALSE(is_inside(-1.01e-9, 1.0, 1e-9));
  EXPECT_TRUE(is_inside(0.0, 0.0, 0.0));
}

TEST(Border, IsNoThinnerThanRounding) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  EXPECT_TRUE(is_inside(-31 * eps * 1e3, -1e3, 1e-15));  // a body of a micrometre, a kilometre away
  EXPECT_FALSE(is_inside(-33 * eps * 1e3, 1e3, 1e-15));
}

TEST(Border, DoesNotHaveWhatIsNoNumber) {
  EXPECT_FALSE(is_inside(std::numeric_limits<double>::quiet_NaN(), 1.0, 1e-9));
}

TEST(Border, OfAPlaneIsMeasuredAcrossItWhateverTheLengthOfItsNormal) {
  for (const double length : {1e-200, 1.0, 1e200}) {
    const Vector3d normal = length * Vector3d(0.6, 0.8, 0.0);
    EXPECT_TRUE(is_in_front({1 - 0.9e-6 * 0.6, 2 - 0.9e-6 * 0.8, 7}, {1, 2, 0}, normal, 1e-6)) << length;
    EXPECT_FALSE(is_in_front({1 - 1.1e-6 * 0.6, 2 - 1.1e-6 * 0.8, 7}, {1, 2, 0}, normal, 1e-6)) << length;
    EXPECT_TRUE(is_in_front({2, 2, 7}, {1, 2, 0}, normal, 1e-6)) << length;
  }
}

// A place far away is known no better than its own coordinates are, wherever the plane is given.
TEST(Border, OfAPlaneHasTheRoundingOfThePlaceToo) {
  EXPECT_TRUE(is_in_front({1e9, -2e-6, 0}, {0, 0, 0}, {0, 1, 0}, 0.0));
  EXPECT_TRUE(is_in_front({0, -2e-6, 0}, {1e9, 0, 0}, {0, 1, 0}, 0.0));
  EXPECT_FALSE(is_in_front({1, -2e-6, 0}, {0, 0, 0}, {0, 1, 0}, 0.0));
}

}  // namespace
}  // namespace dartboard::border_test
