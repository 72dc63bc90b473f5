#include "core/time/system/energy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::energy_test {
namespace {

using Eigen::Vector3d;

SpringArrays stretched_pair() {
  SpringArrays arrays;
  arrays.gravity = {0, 0, -8};
  arrays.add_vertex(2.0, {0, 0, 1}, {1, 0, 0});
  arrays.add_vertex(4.0, {3, 4, 1}, {0, -2, 0});  // 5 m away
  arrays.add_spring(0, 1, 6.0, 4.0);
  return arrays;
}

TEST(Energy, IsThatOfMotionSpringsAndHeight) {
  const SpringArrays arrays = stretched_pair();
  EXPECT_EQ(kinetic_energy(arrays.system(), arrays.v), 1.0 + 8.0);
  EXPECT_EQ(elastic_energy(arrays.system(), arrays.x), 3.0);
  EXPECT_EQ(gravity_energy(arrays.system(), arrays.x), 16.0 + 32.0);
  EXPECT_EQ(total_energy(arrays.system(), arrays.x, arrays.v), 60.0);
}

TEST(Energy, IsInSpringsThatAreCompressedToo) {
  SpringArrays arrays = stretched_pair();
  arrays.springs[0].rest_length = 7.0;
  EXPECT_EQ(elastic_energy(arrays.system(), arrays.x), 12.0);
}

// Blocks of eight coordinates and every remainder.
TEST(SumOfSquares, IsThatOfAllCoordinates) {
  for (int n = 0; n <= 11; ++n) {
    std::vector<Vector3d> v;
    for (int i = 0; i < n; ++i) v.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    const double last = 3 * n - 1;
    EXPECT_EQ(sum_of_squares(v), n == 0 ? 0.0 : last * (last + 1) * (2 * last + 1) / 6) << n;
    if (n > 0) v.back().z() = NAN;
    EXPECT_EQ(std::isnan(sum_of_squares(v)), n > 0) << n;
  }
}

TEST(Momentum, IsLinearAndAngularAboutACentre) {
  const SpringArrays arrays = stretched_pair();
  EXPECT_EQ(linear_momentum(arrays.system(), arrays.v), Vector3d(2, -8, 0));
  // 2 (0,0,1) x (1,0,0) + 4 (3,4,1) x (0,-2,0)
  EXPECT_EQ(angular_momentum(arrays.system(), arrays.x, arrays.v), Vector3d(8, 2, -24));
  EXPECT_EQ(angular_momentum(arrays.system(), arrays.x, arrays.v, {0, 0, 1}), Vector3d(0, 0, -24));
}

TEST(Momentum, LosesNothingBesideALargeTerm) {
  for (const std::array<double, 3>& speeds : {std::array{0x1p60, 1.0, -0x1p60}, {1.0, 0x1p60, -0x1p60}}) {
    SpringArrays arrays;
    for (const double speed : speeds) arrays.add_vertex(1.0, {0, 0, 0}, {speed, 0, 0});
    EXPECT_EQ(linear_momentum(arrays.system(), arrays.v), Vector3d(1, 0, 0));
  }
}

}  // namespace
}  // namespace dartboard::energy_test
