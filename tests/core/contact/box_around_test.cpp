// Boxes around places and ways: equal to those of one place after the other, for every number of places.

#include "core/contact/box_around.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/plain/random.h"

namespace dartboard::box_around_test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> places(std::size_t count, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<Vector3d> x(count);
  for (Vector3d& place : x)
    for (double& c : place) c = random.next_signed();
  return x;
}

BoxAround one_by_one(const std::vector<Vector3d>& x) {
  BoxAround box;
  for (const Vector3d& place : x) {
    box.low = box.low.cwiseMin(place);
    box.high = box.high.cwiseMax(place);
  }
  return box;
}

void expect_same(const BoxAround& a, const BoxAround& b) {
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(BoxAround, HoldsEveryPlaceAndNoMore) {
  for (std::size_t count = 1; count < 15; ++count)
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const auto x = places(count, seed);
      expect_same(box_around(x), one_by_one(x));
    }
}

TEST(BoxAround, HoldsTheWaysOfSomeVerticesAlsoWithinAStep) {
  for (std::size_t count = 1; count < 15; ++count) {
    const auto x = places(20, count), w = places(20, count + 100), from = places(count, count + 200);
    const std::size_t first = 20 - count;  // the last is the last of all
    std::vector<Vector3d> ways(count), within(count);
    for (std::size_t k = 0; k < count; ++k) {
      ways[k] = x[first + k] - from[k];
      within[k] = (x[first + k] - from[k]) + 0.25 * w[first + k];
    }
    BoxAround box, box_within;
    add_ways(box, from, {x}, first);
    expect_same(box, one_by_one(ways));
    add_ways(box_within, from, {x, w, 0.25}, first);
    expect_same(box_within, one_by_one(within));
    // widened, not begun anew
    add_ways(box, std::vector<Vector3d>(2, Vector3d(5, 5, 5)), {std::vector<Vector3d>(2, Vector3d(8, -2, 5))}, 0);
    EXPECT_EQ(box.high, one_by_one(ways).high.cwiseMax(Vector3d(3, -7, 0)));
    EXPECT_EQ(box.low, one_by_one(ways).low.cwiseMin(Vector3d(3, -7, 0)));
  }
}

TEST(BoxAround, LeavesOutWhatIsNotANumber) {
  for (std::size_t at = 0; at < 9; ++at) {
    auto x = places(9, 4);
    x[at].setConstant(std::numeric_limits<double>::quiet_NaN());
    auto rest = x;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
    expect_same(box_around(x), one_by_one(rest));
  }
}

}  // namespace
}  // namespace dartboard::box_around_test
