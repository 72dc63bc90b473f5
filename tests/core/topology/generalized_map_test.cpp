#include "core/topology/generalized_map.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "tests/support/topology_message_for_tests.h"

namespace dartboard::generalized_map_test {
namespace {

TEST(GeneralizedMap, ANewMapHasNoDarts) {
  const Map3 map;
  EXPECT_EQ(map.dart_count(), 0u);
  EXPECT_EQ(map.capacity(), 0u);
  EXPECT_FALSE(map.is_live({0}));
  EXPECT_FALSE(map.is_live(no_dart));
}

TEST(GeneralizedMap, ANewDartIsFreeForEveryInvolution) {
  Map3 map;
  const Dart d = map.add_dart();
  EXPECT_TRUE(map.is_live(d));
  for (int i = 0; i <= 3; ++i) EXPECT_TRUE(map.is_free(i, d)) << i;
}

TEST(GeneralizedMap, LinkTouchesTwoDartsAndNoOther) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart(), c = map.add_dart();
  map.link<1>(a, b);
  EXPECT_EQ(map.alpha<1>(a), b);
  EXPECT_EQ(map.alpha<1>(b), a);
  EXPECT_TRUE(map.is_free<1>(c));
  for (const Dart d : {a, b})
    for (const int i : {0, 2}) EXPECT_TRUE(map.is_free(i, d));
}

TEST(GeneralizedMap, AlphasAreAppliedFromLeftToRight) {
  Map3 map;
  const Dart a = map.add_dart(), b = map.add_dart(), c = map.add_dart(), d = map.add_dart();
  map.link<0>(a, b);
  map.link<1>(b, c);
  map.link<3>(c, d);
  EXPECT_EQ((map.alpha<0, 1, 3>(a)), d);
  EXPECT_EQ((map.alpha<3, 1, 0>(a)), b);  // a is 3-free and 1-free
  EXPECT_EQ((map.alpha<3, 1, 0>(d)), a);
}

TEST(GeneralizedMap, LinkingADartThatIsNotFreeNamesBothDartsAndTheObstacle) {
  Map3 map;
  const Dart a = map.add_dart(), b = map.add_dart(), c = map.add_dart();
  map.link<1>(a, b);
  const auto before = map.hash();
  EXPECT_EQ(message_of([&] { map.link<1>(a, c); }), "cannot 1-link d0 to d2: alpha1(d0) = d1, expected free");
  EXPECT_EQ(message_of([&] { map.link<1>(c, b); }), "cannot 1-link d2 to d1: alpha1(d1) = d0, expected free");
  EXPECT_EQ(map.hash(), before);
}

TEST(GeneralizedMap, LinkingADartToItselfIsRefused) {
  Map3 map;
  const Dart a = map.add_dart();
  EXPECT_EQ(message_of([&] { map.link<2>(a, a); }), "cannot 2-link d0 to itself: alpha2(d0) = d0 is what 2-free means");
}

TEST(GeneralizedMap, LinkingADeadDartIsRefusedOnEitherSide) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart();
  map.remove_dart(b);
  const auto before = map.hash();
  EXPECT_EQ(message_of([&] { map.link<0>(a, b); }), "d1 is dead, expected a live dart");
  EXPECT_EQ(message_of([&] { map.link<0>(b, a); }), "d1 is dead, expected a live dart");
  EXPECT_EQ(message_of([&] { map.link<0>(a, Dart{77}); }), "d77 is dead, expected a live dart");
  EXPECT_EQ(message_of([&] { map.link<0>(a, no_dart); }), "no dart given, expected a live one");
  EXPECT_EQ(map.hash(), before);
}

TEST(GeneralizedMap, UnlinkFreesBothDartsFromEitherSide) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart();
  const auto before = map.hash();
  map.link<2>(a, b);
  map.unlink<2>(b);
  EXPECT_EQ(map.hash(), before);
}

TEST(GeneralizedMap, UnlinkingAFreeDartDoesNothing) {
  Map2 map;
  const Dart a = map.add_dart();
  const auto before = map.hash();
  map.unlink<0>(a);
  EXPECT_EQ(map.hash(), before);
}

TEST(GeneralizedMap, UnlinkingADeadDartIsRefused) {
  Map2 map;
  EXPECT_EQ(message_of([&] { map.unlink<0>(Dart{0}); }), "d0 is dead, expected a live dart");
}

TEST(GeneralizedMap, OnlyAFreeDartCanBeRemoved) {
  Map3 map;
  const Dart a = map.add_dart(), b = map.add_dart();
  map.link<3>(a, b);
  EXPECT_EQ(message_of([&] { map.remove_dart(a); }), "cannot remove d0: alpha3(d0) = d1, expected free");
  EXPECT_EQ(map.dart_count(), 2u);
  map.unlink<3>(a);
  map.remove_dart(a);
  EXPECT_EQ(map.dart_count(), 1u);
  EXPECT_EQ(message_of([&] { map.remove_dart(a); }), "d0 is dead, expected a live dart");
}

TEST(GeneralizedMap, DeadSlotsAreUsedAgainLastOutFirstIn) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart(), c = map.add_dart();
  map.remove_dart(a);
  map.remove_dart(c);
  EXPECT_EQ(map.add_dart(), c);
  EXPECT_EQ(map.add_dart(), a);
  EXPECT_EQ(map.add_dart(), Dart{3});
  EXPECT_TRUE(map.is_live(b));
}

TEST(GeneralizedMap, WalksOverDartsSkipDeadSlots) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart(), c = map.add_dart();
  map.remove_dart(b);
  std::vector<Dart> met;
  map.for_each_dart([&](Dart d) { met.push_back(d); });
  EXPECT_EQ(met, (std::vector<Dart>{a, c}));
}

TEST(DartIds, ResolveToTheirDartWhileItLives) {
  Map2 map;
  const Dart a = map.add_dart();
  EXPECT_EQ(map.resolve(map.id(a)), a);
}

TEST(DartIds, DetectADeadDart) {
  Map2 map;
  const Dart a = map.add_dart();
  const DartId id = map.id(a);
  map.remove_dart(a);
  EXPECT_EQ(message_of([&] { map.resolve(id); }), "d0 is dead, expected a live dart");
  EXPECT_EQ(message_of([&] { map.id(a); }), "d0 is dead, expected a live dart");
}

TEST(DartIds, DetectThatTheSlotHoldsAnotherDart) {
  Map2 map;
  const Dart a = map.add_dart();
  const DartId id = map.id(a);
  map.remove_dart(a);
  const Dart again = map.add_dart();
  ASSERT_EQ(again, a);
  EXPECT_EQ(message_of([&] { map.resolve(id); }),
            "d0 has died and its slot holds another dart (generation 2, expected 1)");
  EXPECT_EQ(map.resolve(map.id(again)), again);
}

TEST(DartIds, ADefaultIdNamesNoDart) {
  Map2 map;
  map.add_dart();
  EXPECT_EQ(message_of([&] { map.resolve(DartId{}); }), "no dart given, expected a live one");
  EXPECT_EQ(message_of([&] {
              map.resolve(DartId{Dart{0}, 0});
            }),
            "d0 has died and its slot holds another dart "
            "(generation 1, expected 0)");
}

TEST(CopiedMap, EqualsTheOriginalAndLivesOnItsOwn) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart();
  Map2 copy = map;
  EXPECT_EQ(copy.hash(), map.hash());
  copy.link<0>(a, b);
  EXPECT_TRUE(map.is_free<0>(a));
}

TEST(CopiedMap, SharesNoMarks) {
  Map2 map;
  const Dart a = map.add_dart();
  Mark mark(map);
  mark.set(a);
  const Map2 copy = map;
  EXPECT_EQ(map.marks().in_use(), 1u);
  EXPECT_EQ(copy.marks().in_use(), 0u);
  EXPECT_FALSE(Mark(copy)(a));
}

TEST(CopiedMap, SharesNoJournal) {
  Map2 map;
  Journal journal;
  map.attach(&journal);
  map.add_dart();
  Map2 copy = map;
  copy.add_dart();
  EXPECT_EQ(journal.position(), 1u);
  map.add_dart();
  EXPECT_EQ(journal.position(), 2u);
}

TEST(CopiedMap, CanBeAssignedToItself) {
  Map2 map;
  map.link<0>(map.add_dart(), map.add_dart());
  const auto before = map.hash();
  const Map2& same = map;
  map = same;
  EXPECT_EQ(map.hash(), before);
  EXPECT_EQ(map.alpha<0>({0}), Dart{1});
}

TEST(MovedMap, KeepsItsDartsItsIdsAndItsJournal) {
  Map2 map;
  Journal journal;
  map.attach(&journal);
  const DartId id = map.id(map.add_dart());
  Map2 moved = std::move(map);
  EXPECT_EQ(moved.resolve(id), Dart{0});
  moved.add_dart();
  EXPECT_EQ(journal.position(), 2u);
}

TEST(MapHash, TellsInWhichOrderDeadSlotsWillBeUsedAgain) {
  Map2 map;
  map.add_dart();
  map.add_dart();
  Map2 other = map;
  map.remove_dart({0});
  map.remove_dart({1});
  other.remove_dart({1});
  other.remove_dart({0});
  EXPECT_NE(map.hash(), other.hash());
}

}  // namespace
}  // namespace dartboard::generalized_map_test
