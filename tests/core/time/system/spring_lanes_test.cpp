#include "core/time/system/spring_lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>
#include <type_traits>

#include "core/base/lanes.h"

namespace dartboard::spring_lanes_test {
namespace {

using Eigen::Vector3d;

/// Springs between random vertices, the first four with the first vertex and the last one with the last vertex.
struct Tangle {
  std::vector<SpringEnds> ends;
  std::vector<Spring> damped;
  std::vector<UndampedSpring> undamped;
  std::vector<Vector3d> x, v;

  Tangle(std::uint32_t vertices, std::size_t springs, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (std::uint32_t i = 0; i < vertices; ++i) {
      x.push_back(vector());
      v.push_back(vector());
    }
    for (std::size_t s = 0; s < springs; ++s) {
      const auto i = static_cast<std::uint32_t>(random() % vertices);
      const auto step = 1 + static_cast<std::uint32_t>(random() % (vertices - 1));
      ends.push_back({s < 4 ? 0 : s + 1 == springs ? vertices - 1 : i, 0});
      ends.back()[1] = (ends.back()[0] + step) % vertices;
      damped.push_back({1.0 + number(random), 10.0 + number(random), 0.1 + 0.1 * number(random)});
      undamped.push_back({damped.back().rest_length, damped.back().stiffness});
    }
  }
};

template <class Row>
std::vector<Row> in_rows(const std::vector<Vector3d>& column) {
  std::vector<Row> rows;
  for (const Vector3d& v : column) rows.emplace_back(v);
  return rows;
}
template <class Row>
std::vector<std::uint64_t> bits_of(const std::vector<Row>& column) {
  std::vector<std::uint64_t> bits;
  for (const Row& row : column)
    for (const double number : three_of(row))
      bits.push_back(std::isnan(number) ? 0 : std::bit_cast<std::uint64_t>(number));
  return bits;
}

/// The forces one by one, and those in lanes with the rest one by one.
template <bool damped, class Row, class SomeSpring>
void expect_equal_bits(const Tangle& t, const std::vector<SomeSpring>& springs) {
  const std::vector<Vector3d> none(t.x.size(), Vector3d(0, 0, 0));
  std::vector<Vector3d> expected = none;
  const SpringColumnsAt<Vector3d> by_threes{t.ends.data(), t.x, t.v.data(), expected.data()};
  add_forces_one_by_one<damped>(by_threes, springs.data(), 0, springs.size());
  const std::vector<Row> x = in_rows<Row>(t.x), v = in_rows<Row>(t.v);
  std::vector<Row> found = in_rows<Row>(none);
  const SpringColumnsAt<Row> at{t.ends.data(), x, v.data(), found.data()};
  const std::size_t done = add_forces_in_lanes<damped>(at, std::span<const SomeSpring>(springs));
  ASSERT_EQ(done, springs.size() / 4 * 4);
  add_forces_one_by_one<damped>(at, springs.data(), done, springs.size());
  ASSERT_EQ(bits_of(found), bits_of(expected));
}
template <class Row>
void expect_equal_bits_in(const Tangle& t) {
  expect_equal_bits<true, Row>(t, t.damped);
  expect_equal_bits<false, Row>(t, t.damped);
  expect_equal_bits<false, Row>(t, t.undamped);
}
void expect_equal_directions(const Tangle& t) {
  std::vector<Vector3d> expected, found(t.ends.size(), Vector3d(7, 7, 7));
  for (const SpringEnds& ends : t.ends) expected.push_back(direction_of(ends, t.x.data()));
  const std::size_t done = find_directions_in_lanes(t.ends, t.x, found.data());
  ASSERT_EQ(done, t.ends.size() / 4 * 4);
  for (std::size_t s = done; s < found.size(); ++s) {
    ASSERT_EQ(found[s], Vector3d(7, 7, 7)) << "written behind the last of four";
    found[s] = expected[s];
  }
  ASSERT_EQ(bits_of(found), bits_of(expected));
}
void expect_equal_bits(const Tangle& t) {
  expect_equal_bits_in<Vector3d>(t);
  expect_equal_bits_in<PaddedVector>(t);
  expect_equal_directions(t);
}

class SpringLanes : public testing::Test {
 protected:
  void SetUp() override {
    use_lanes(true);
    if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  }
};

TEST_F(SpringLanes, HaveTheBitsOfOneByOneForAnyNumberOfSprings) {
  for (std::size_t springs = 1; springs < 20; ++springs)
    for (unsigned seed = 0; seed < 5; ++seed) expect_equal_bits(Tangle(6 + 2 * seed, springs, seed));
  expect_equal_bits(Tangle(400, 3001, 7));
}

TEST_F(SpringLanes, PullNowhereAtZeroLength) {
  Tangle t(30, 64, 1);
  for (const std::size_t s : {5, 14, 23, 32}) {
    t.x[t.ends[s][1]] = t.x[t.ends[s][0]];
    expect_equal_bits(t);
  }
}

// Its square is zero, and so is its length; a direction would have the signs of its components.
TEST_F(SpringLanes, HaveNoDirectionAtALengthThatUnderflows) {
  Tangle t(30, 64, 4);
  t.x[t.ends[9][1]] = t.x[t.ends[9][0]] = Vector3d(0, 0, 0);
  t.x[t.ends[9][1]].y() = -1e-200;
  expect_equal_bits(t);
}

TEST_F(SpringLanes, KeepWhatIsNotANumber) {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    Tangle t(30, 64, 2);
    t.x[t.ends[9][0]].y() = wrong;
    expect_equal_bits(t);
  }
}

TEST_F(SpringLanes, CanBeTurnedOffAndOnAgain) {
  const Tangle t(30, 64, 3);
  std::vector<Vector3d> force(t.x.size(), Vector3d(0, 0, 0));
  const SpringColumnsAt<Vector3d> at{t.ends.data(), t.x, t.v.data(), force.data()};
  const std::span<const Spring> springs(t.damped);
  EXPECT_TRUE(use_lanes(false));
  EXPECT_EQ(add_forces_in_lanes<true>(at, springs), 0u);
  EXPECT_FALSE(use_lanes(true));
  EXPECT_EQ(add_forces_in_lanes<true>(at, springs), 64u);
}

}  // namespace
}  // namespace dartboard::spring_lanes_test
