#include "core/topology/orbit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/topology/build.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::orbit_test {
namespace {

// Maps to walk on: with sewn and free faces, and with a dead cell in the middle of the slots.
template <class Map>
Map a_map() {
  constexpr int n = Map::dimension;
  Map map = n == 2 ? build_map<Map>(quadrilateral_grid(3, 2)).map : build_map<Map>(kuhn_grid(2, 1, 1, 1.0)).map;
  std::mt19937 bits(7);
  for (int k = 0; k < 5; ++k) unsew<n>(map, Dart{static_cast<std::uint32_t>(bits() % map.capacity())});
  const Dart middle{static_cast<std::uint32_t>(map.capacity() / 2)};
  const std::vector<Dart> cell = orbit(map, cell_involutions(n, n), middle);
  for (const Dart d : cell) unsew<n>(map, d);
  remove_cell(map, cell.front());
  return map;
}

using Darts = std::set<Dart>;

// Add the alphas of every member until nothing is new.
template <class Map>
Darts naive_closure(const Map& map, Involutions set, Dart d) {
  Darts closure{d};
  for (std::size_t size = 0; size != closure.size();) {
    size = closure.size();
    for (const Dart e : Darts(closure))
      for (int i = 0; i <= Map::dimension; ++i)
        if (set.contains(i)) closure.insert(map.alpha(i, e));
  }
  return closure;
}

template <class Map>
class Orbit : public testing::Test {
 protected:
  static constexpr unsigned subsets = 1u << (Map::dimension + 1);
  Map map = a_map<Map>();
};

using Maps = testing::Types<Map2, Map3, TetMap>;
TYPED_TEST_SUITE(Orbit, Maps);

TYPED_TEST(Orbit, OfEverySubsetAndEveryDartIsTheNaiveClosure) {
  for (unsigned bits = 0; bits < this->subsets; ++bits) {
    const auto set = Involutions::from_bits(bits);
    this->map.for_each_dart([&](Dart d) {
      const std::vector<Dart> walked = orbit(this->map, set, d);
      const Darts as_set(walked.begin(), walked.end());
      ASSERT_EQ(walked.size(), as_set.size()) << "a dart twice, subset " << bits << " from " << to_string(d);
      ASSERT_EQ(as_set, naive_closure(this->map, set, d)) << "subset " << bits << " from " << to_string(d);
    });
  }
}

TYPED_TEST(Orbit, StopsAtTheDartWhereTheVisitorSaysSo) {
  const Involutions set = cell_involutions(TypeParam::dimension, 0);
  const std::vector<Dart> all = orbit(this->map, set, {0});
  ASSERT_GE(all.size(), 2u);
  for (std::size_t stop = 0; stop < all.size(); ++stop) {
    std::vector<Dart> met;
    EXPECT_TRUE(for_each_dart_of(this->map, set, {0}, [&](Dart d) {
      met.push_back(d);
      return met.size() == stop + 1;
    }));
    EXPECT_EQ(met, std::vector<Dart>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(stop) + 1));
  }
  EXPECT_FALSE(for_each_dart_of(this->map, set, {0}, [](Dart) { return false; }));
}

TYPED_TEST(Orbit, LeavesNoMarkBehindWhenTheVisitorThrows) {
  const Involutions set = all_involutions(TypeParam::dimension);
  EXPECT_THROW(for_each_dart_of(this->map, set, {0}, [](Dart) { throw 1; }), int);
  EXPECT_EQ(this->map.marks().in_use(), 0u);
  EXPECT_EQ(orbit(this->map, set, {0}).size(), naive_closure(this->map, set, {0}).size());
}

TYPED_TEST(Orbit, CanBeWalkedWithinAWalk) {
  const Involutions outer = all_involutions(TypeParam::dimension), inner = cell_involutions(TypeParam::dimension, 1);
  std::size_t met = 0;
  for_each_dart_of(this->map, outer, {0}, [&](Dart d) {
    ++met;
    ASSERT_EQ(orbit(this->map, inner, d).size(), naive_closure(this->map, inner, d).size());
  });
  EXPECT_EQ(met, naive_closure(this->map, outer, {0}).size());
}

TYPED_TEST(Orbit, CoverageMeetsEachOrbitOnceByItsLowestDartAscending) {
  for (unsigned bits = 0; bits < this->subsets; ++bits) {
    const auto set = Involutions::from_bits(bits);
    std::vector<Dart> expected;
    this->map.for_each_dart([&](Dart d) {
      if (*naive_closure(this->map, set, d).begin() == d) expected.push_back(d);
    });
    std::vector<Dart> met;
    for_each_orbit(this->map, set, [&](Dart d) { met.push_back(d); });
    EXPECT_EQ(met, expected) << "subset " << bits;
    EXPECT_EQ(count_orbits(this->map, set), expected.size());
  }
}

TYPED_TEST(Orbit, CoveragesCanBeNested) {
  const Involutions set = cell_involutions(TypeParam::dimension, 0);
  const std::size_t n = count_orbits(this->map, set);
  std::size_t pairs = 0;
  for_each_orbit(this->map, set, [&](Dart) { for_each_orbit(this->map, set, [&](Dart) { ++pairs; }); });
  EXPECT_EQ(pairs, n * n);
}

TYPED_TEST(Orbit, IsTheSameForTwoDartsExactlyWhenOneReachesTheOther) {
  for (int i = 0; i <= TypeParam::dimension; ++i) {
    const Involutions set = cell_involutions(TypeParam::dimension, i);
    const Darts from_zero = naive_closure(this->map, set, {0});
    this->map.for_each_dart([&](Dart d) {
      ASSERT_EQ(same_orbit(this->map, set, {0}, d), from_zero.contains(d));
      ASSERT_EQ(same_orbit(this->map, set, d, {0}), from_zero.contains(d));
    });
  }
}

// A face orbit that stops on an open face after 1 of 6 darts was a bug in another library.
TEST(OrbitOfAnOpenFace, IsFoundFromEitherEndAndFromTheMiddle) {
  Map3 map;
  for (int k = 0; k < 6; ++k) map.add_dart();
  map.link<0>({0}, {1});
  map.link<1>({1}, {2});
  map.link<0>({2}, {3});
  map.link<1>({3}, {4});
  map.link<0>({4}, {5});
  for (std::uint32_t d = 0; d < 6; ++d) EXPECT_EQ((orbit<0, 1>(map, {d}).size()), 6u) << d;
}

TEST(Involutions, NameTheCellsAndTheLinesThatASewTreatsAlike) {
  EXPECT_EQ(cell_involutions(3, 0), (Involutions{1, 2, 3}));
  EXPECT_EQ(cell_involutions(2, 2), (Involutions{0, 1}));
  EXPECT_EQ(all_involutions(3), (Involutions{0, 1, 2, 3}));
  EXPECT_EQ(sew_involutions(3, 0), (Involutions{2, 3}));
  EXPECT_EQ(sew_involutions(3, 1), (Involutions{3}));
  EXPECT_EQ(sew_involutions(3, 2), (Involutions{0}));
  EXPECT_EQ(sew_involutions(3, 3), (Involutions{0, 1}));
  EXPECT_EQ(sew_involutions(2, 1), Involutions{});
}

}  // namespace
}  // namespace dartboard::orbit_test
