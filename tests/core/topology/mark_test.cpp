#include "core/topology/mark.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>

#include "core/topology/generalized_map.h"

namespace dartboard::mark_test {
namespace {

Map2 darts(int n) {
  Map2 map;
  for (int k = 0; k < n; ++k) map.add_dart();
  return map;
}

TEST(Mark, IsUnsetOnEveryDartAtFirst) {
  const Map2 map = darts(5);
  const Mark mark(map);
  map.for_each_dart([&](Dart d) { EXPECT_FALSE(mark(d)); });
}

TEST(Mark, IsSetAndUnsetDartByDart) {
  const Map2 map = darts(3);
  Mark mark(map);
  mark.set({1});
  EXPECT_FALSE(mark({0}));
  EXPECT_TRUE(mark({1}));
  mark.unset({1});
  mark.unset({2});  // was not set
  EXPECT_FALSE(mark({1}));
  EXPECT_FALSE(mark({2}));
}

// Whatever room the mark has made, some new dart is the first beyond it.
TEST(Mark, KeepsWhatIsSetOnDartsThatAreNew) {
  for (int n = 1; n < 100; ++n) {
    Map2 map = darts(n);
    Mark mark(map), other(map);
    for (int k = 0; k < 100; ++k) {
      const Dart d = map.add_dart();
      EXPECT_FALSE(mark(d));
      mark.set(d);
      EXPECT_TRUE(mark(d)) << n << " " << k;
      EXPECT_TRUE(other.set_if_new(d));
      EXPECT_FALSE(other.set_if_new(d)) << n << " " << k;
    }
  }
}

TEST(Mark, SetIfNewTellsTheFirstTimeOnly) {
  const Map2 map = darts(1);
  Mark mark(map);
  EXPECT_TRUE(mark.set_if_new({0}));
  EXPECT_FALSE(mark.set_if_new({0}));
  mark.unset({0});
  EXPECT_TRUE(mark.set_if_new({0}));
}

TEST(Mark, ClearUnsetsEveryDart) {
  const Map2 map = darts(4);
  Mark mark(map);
  for (int round = 0; round < 1000; ++round) {
    map.for_each_dart([&](Dart d) { EXPECT_TRUE(mark.set_if_new(d)); });
    mark.clear();
  }
  map.for_each_dart([&](Dart d) { EXPECT_FALSE(mark(d)); });
}

TEST(Mark, IsReleasedWithItsScope) {
  const Map2 map = darts(2);
  {
    Mark mark(map);
    mark.set({0});
    EXPECT_EQ(map.marks().in_use(), 1u);
  }
  EXPECT_EQ(map.marks().in_use(), 0u);
  EXPECT_FALSE(Mark(map)({0}));  // the next user of the same bits
}

TEST(Mark, AMovedMarkIsReleasedOnce) {
  const Map2 map = darts(2);
  {
    Mark first(map);
    first.set({1});
    const Mark second = std::move(first);
    EXPECT_EQ(map.marks().in_use(), 1u);
    EXPECT_TRUE(second({1}));
  }
  EXPECT_EQ(map.marks().in_use(), 0u);
}

// CGAL throws at the 33rd.
TEST(Mark, AHundredMarksLiveSideBySide) {
  const Map2 map = darts(100);
  std::deque<Mark> marks;
  for (std::uint32_t k = 0; k < 100; ++k) marks.emplace_back(map).set({k});
  EXPECT_EQ(map.marks().in_use(), 100u);
  for (std::uint32_t k = 0; k < 100; ++k)
    for (std::uint32_t d = 0; d < 100; ++d) EXPECT_EQ(marks[k]({d}), k == d);
  marks.clear();
  EXPECT_EQ(map.marks().in_use(), 0u);
}

TEST(Mark, AMarkReleasedOutOfOrderDisturbsNoOther) {
  const Map2 map = darts(3);
  Mark a(map);
  auto b = std::make_unique<Mark>(map);
  Mark c(map);
  a.set({0});
  c.set({2});
  b.reset();
  const Mark d(map);  // takes the bits of b
  EXPECT_TRUE(a({0}));
  EXPECT_TRUE(c({2}));
  EXPECT_FALSE(d({0}));
}

TEST(Mark, DartsBornLaterAreUnmarkedAndCanBeMarked) {
  Map2 map = darts(1);
  Mark mark(map);
  mark.set({0});
  for (int k = 0; k < 1000; ++k) {
    const Dart d = map.add_dart();
    EXPECT_FALSE(mark(d));
    mark.set(d);
  }
  map.for_each_dart([&](Dart d) { EXPECT_TRUE(mark(d)); });
}

TEST(Mark, ANewDartInAUsedSlotIsUnmarkedInEveryMark) {
  Map2 map = darts(3);
  Mark first(map), second(map);
  first.set({1});
  second.set({1});
  map.remove_dart({1});
  ASSERT_EQ(map.add_dart(), Dart{1});
  EXPECT_FALSE(first({1}));
  EXPECT_FALSE(second({1}));
}

TEST(Mark, ANewTetrahedronInAUsedSlotIsUnmarked) {
  TetMap map;
  map.add_tetrahedron();
  Mark mark(map);
  for (std::uint32_t p = 0; p < 24; ++p) mark.set({p});
  map.remove_tetrahedron({0});
  ASSERT_EQ(map.add_tetrahedron(), Dart{0});
  for (std::uint32_t p = 0; p < 24; ++p) EXPECT_FALSE(mark({p})) << p;
}

TEST(Mark, ABitOfAnEarlierMarkDoesNotComeBack) {
  Map2 map = darts(2);
  for (int round = 0; round < 100; ++round) {  // the same bits, taken again and again
    Mark mark(map);
    EXPECT_FALSE(mark({0}));
    EXPECT_FALSE(mark({1}));
    mark.set({static_cast<std::uint32_t>(round % 2)});
  }
}

// A dart that is unset and set again puts its word on the list of those to be cleared once more.
TEST(Mark, IsClearedAfterItWasUnsetAndSetAnyNumberOfTimes) {
  const Map2 map = darts(40);
  for (int round = 0; round < 3; ++round) {
    Mark mark(map);
    for (int k = 0; k < 1000; ++k) {
      EXPECT_TRUE(mark.set_if_new({17}));
      mark.unset({17});
    }
    mark.set({18});
    if (round == 1) mark.clear();
    for (std::uint32_t d = 0; d < 40; ++d) EXPECT_EQ(mark({d}), round != 1 && d == 18) << d;
  }
}

TEST(Mark, SetsDartsOfOneWordWithoutEachOther) {
  const Map2 map = darts(200);
  Mark mark(map);
  for (std::uint32_t d = 0; d < 200; d += 3) EXPECT_TRUE(mark.set_if_new({d}));
  for (std::uint32_t d = 0; d < 200; ++d) EXPECT_EQ(mark({d}), d % 3 == 0) << d;
  for (std::uint32_t d = 0; d < 200; d += 6) mark.unset({d});
  for (std::uint32_t d = 0; d < 200; ++d) EXPECT_EQ(mark({d}), d % 6 == 3) << d;
}

TEST(Mark, TakesABitForEachDart) {
  const Map2 map = darts(1600);
  { const Mark first(map), second(map); }
  MarkPool::Bits& bits = map.marks().take(map.capacity());
  EXPECT_EQ(bits.words.size() * sizeof(bits.words[0]), 200u);
  bits.in_use = false;
}

}  // namespace
}  // namespace dartboard::mark_test
