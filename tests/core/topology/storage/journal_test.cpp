#include "core/topology/storage/journal.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"

namespace dartboard::journal_test {
namespace {

// One random operation on a map of tetrahedra: a birth, a death, a face sewn or unsewn. Refusals change nothing.
template <class Map>
void random_operation(Map& map, std::mt19937& bits) {
  const auto any = [&] { return Dart{static_cast<std::uint32_t>(bits() % (map.capacity() + 1))}; };
  const auto what = bits() % 8;
  try {
    if (what == 0 || map.capacity() == 0) add_cell(map, CellKind::tetrahedron);
    if (what == 1) remove_cell(map, any());
    if (what == 2 || what == 3) unsew<3>(map, any());
    if (what > 3) {
      const Dart a = any(), b = any();
      sew<3>(map, a, b);
    }
  } catch (const TopologyError&) {
  }
}

struct Snapshot {
  Journal::Position position;
  std::uint64_t hash;
};

template <class Map>
class Journals : public testing::Test {
 protected:
  Journals() { map_.attach(&journal_); }
  Snapshot snapshot() const { return {journal_.position(), map_.hash()}; }

  Map map_;
  Journal journal_;
};
using Maps = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Journals, Maps);

TYPED_TEST(Journals, RestoreTheHashOfEveryMomentInAnyOrder) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 bits(seed);
    TypeParam map;
    Journal journal;
    map.attach(&journal);
    std::vector<Snapshot> history{{0, map.hash()}};
    for (int step = 0; step < 150; ++step) {
      random_operation(map, bits);
      history.push_back({journal.position(), map.hash()});
    }
    for (int jump = 0; jump < 60; ++jump) {
      const Snapshot& to = history[bits() % history.size()];
      journal.undo(map, to.position);
      journal.redo(map, to.position);
      ASSERT_EQ(journal.position(), to.position);
      ASSERT_EQ(map.hash(), to.hash) << "seed " << seed << ", position " << to.position;
      ASSERT_EQ(check(map), "");
    }
  }
}

TYPED_TEST(Journals, BeginAgainWhenTheyAreCleared) {
  this->map_.attach(&this->journal_);
  add_cell(this->map_, CellKind::tetrahedron);
  ASSERT_GT(this->journal_.position(), 0u);
  this->journal_.clear();
  EXPECT_EQ(this->journal_.position(), 0u);
  EXPECT_EQ(this->journal_.end(), 0u);
  const auto hash = this->map_.hash();
  add_cell(this->map_, CellKind::tetrahedron);
  EXPECT_EQ(this->journal_.position(), this->journal_.end());
  this->journal_.undo(this->map_, 0);
  EXPECT_EQ(this->map_.hash(), hash);
}

TYPED_TEST(Journals, ForgetWhatCouldBeRedoneWhenSomethingNewHappens) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 bits(100 + seed);
    TypeParam map;
    Journal journal;
    map.attach(&journal);
    std::vector<Snapshot> history{{0, map.hash()}};
    for (int step = 0; step < 300; ++step) {
      if (bits() % 5 == 0) {  // back, and on from there along another branch
        history.resize(1 + bits() % history.size());
        journal.undo(map, history.back().position);
        ASSERT_EQ(map.hash(), history.back().hash);
      }
      random_operation(map, bits);
      history.push_back({journal.position(), map.hash()});
    }
    while (!history.empty()) {
      journal.undo(map, history.back().position);
      ASSERT_EQ(map.hash(), history.back().hash);
      history.pop_back();
    }
    EXPECT_EQ(map.dart_count(), 0u);
  }
}

TYPED_TEST(Journals, TakeBackAnInnerPartAndThenTheWhole) {
  auto& map = this->map_;
  auto& journal = this->journal_;
  const Snapshot outer = this->snapshot();
  add_cell(map, CellKind::tetrahedron);
  add_cell(map, CellKind::tetrahedron);
  const Snapshot inner = this->snapshot();
  sew<3>(map, {0}, {24});
  journal.undo(map, inner.position);
  EXPECT_EQ(map.hash(), inner.hash);
  sew<3>(map, {6}, {33});
  journal.undo(map, outer.position);
  EXPECT_EQ(map.hash(), outer.hash);
  EXPECT_EQ(map.capacity(), 0u);
}

TYPED_TEST(Journals, ADeathUndoneBringsBackTheSameDart) {
  auto& map = this->map_;
  const Dart d = add_cell(map, CellKind::tetrahedron);
  const DartId id = map.id(d);
  const auto alive = this->journal_.position();
  remove_cell(map, d);
  add_cell(map, CellKind::tetrahedron);  // another one in the same slots
  EXPECT_THROW(map.resolve(id), TopologyError);
  this->journal_.undo(map, alive);
  EXPECT_EQ(map.resolve(id), d);
  this->journal_.redo(map, this->journal_.end());
  EXPECT_THROW(map.resolve(id), TopologyError);
}

TYPED_TEST(Journals, ABirthUndoneIsADeath) {
  auto& map = this->map_;
  const DartId id = map.id(add_cell(map, CellKind::tetrahedron));
  this->journal_.undo(map, 0);
  EXPECT_THROW(map.resolve(id), TopologyError);
  this->journal_.redo(map, this->journal_.end());
  EXPECT_EQ(map.resolve(id), Dart{0});
}

TYPED_TEST(Journals, AnIdOfAnotherBranchIsNotMistakenForANewDart) {
  auto& map = this->map_;
  const DartId id = map.id(add_cell(map, CellKind::tetrahedron));
  this->journal_.undo(map, 0);
  const Dart again = add_cell(map, CellKind::tetrahedron);
  ASSERT_EQ(again, id.dart);
  EXPECT_THROW(map.resolve(id), TopologyError);
  EXPECT_EQ(map.resolve(map.id(again)), again);
}

TYPED_TEST(Journals, HoldNothingOfARefusedOperation) {
  auto& map = this->map_;
  add_cell(map, CellKind::tetrahedron);
  add_cell(map, CellKind::tetrahedron);
  sew<3>(map, {0}, {24});
  const auto before = this->journal_.position();
  EXPECT_THROW(sew<3>(map, Dart{0}, Dart{30}), TopologyError);
  EXPECT_THROW(remove_cell(map, Dart{0}), TopologyError);
  EXPECT_EQ(this->journal_.position(), before);
}

TYPED_TEST(Journals, RecordNothingOnceDetached) {
  auto& map = this->map_;
  map.attach(nullptr);
  add_cell(map, CellKind::tetrahedron);
  EXPECT_EQ(this->journal_.position(), 0u);
}

TYPED_TEST(Journals, UndoOfTheFutureAndRedoOfThePastDoNothing) {
  auto& map = this->map_;
  add_cell(map, CellKind::tetrahedron);
  const Snapshot now = this->snapshot();
  this->journal_.undo(map, now.position + 10);
  this->journal_.redo(map, 0);
  this->journal_.redo(map, now.position + 10);
  EXPECT_EQ(this->journal_.position(), now.position);
  EXPECT_EQ(map.hash(), now.hash);
}

// A face of a TetMap is four bytes here and four there, whatever its darts.
TEST(TetMapJournal, WritesTwoChangesForASewnFace) {
  TetMap map;
  map.add_tetrahedron();
  map.add_tetrahedron();
  Journal journal;
  map.attach(&journal);
  sew<3>(map, {0}, {24});
  EXPECT_EQ(journal.position(), 2u);
}

}  // namespace
}  // namespace dartboard::journal_test
