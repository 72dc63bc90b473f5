#include "core/views/slack_rows.h"

#include <gtest/gtest.h>

#include "core/plain/random.h"

namespace dartboard {
namespace {

using Rows = SlackRows<int, char>;

template <std::size_t c>
auto row_of(const Rows& rows, std::size_t row) {
  const auto first = rows.column<c>().begin() + rows.start(row);
  return std::vector(first, first + rows.length(row));
}

TEST(SlackRowsOf, TwoColumnsKeepThemSideBySide) {
  Rows rows;
  rows.add_row();
  rows.insert(0, 0, 7, 'g');
  rows.insert(0, 0, 1, 'a');
  rows.insert(0, 1, 4, 'd');
  EXPECT_EQ(row_of<0>(rows, 0), (std::vector{1, 4, 7}));
  EXPECT_EQ(row_of<1>(rows, 0), (std::vector{'a', 'd', 'g'}));
  rows.erase(0, 1);
  EXPECT_EQ(row_of<0>(rows, 0), (std::vector{1, 7}));
  EXPECT_EQ(row_of<1>(rows, 0), (std::vector{'a', 'g'}));
}

TEST(SlackRowsOf, NothingBeginAgainWithoutRooms) {
  Rows rows;
  for (int row = 0; row < 3; ++row) rows.add_row();
  for (int k = 0; k < 9; ++k) rows.insert(1, 0, k, 'a');  // leaves rooms of 4 and 8
  rows.clear();
  EXPECT_EQ(rows.count(), 0u);
  for (std::size_t row = 0; row < 3; ++row) {
    rows.add_row(5);
    ASSERT_LE(static_cast<std::size_t>(rows.start(row)) + 8, rows.column<0>().size());
    rows.insert(row, 0, static_cast<int>(row), 'b');
  }
  for (std::size_t row = 0; row < 3; ++row) EXPECT_EQ(row_of<0>(rows, row), std::vector{static_cast<int>(row)});
}

TEST(SlackRowsOf, NothingHoldNothing) {
  Rows rows;
  rows.add_row(5);
  rows.clear();
  EXPECT_TRUE(rows.column<0>().empty());
  EXPECT_TRUE(rows.column<1>().empty());
  rows.add_row();
  EXPECT_EQ(rows.start(0), 0);
}

TEST(SlackRowsOf, RandomEditsAreThoseOfVectors) {
  Rows rows;
  std::vector<std::vector<int>> expected;
  SplitMix64 random(5);
  for (int k = 0; k < 5000; ++k) {
    const std::uint32_t what = random.below(20);
    if (expected.empty() || what == 0) {
      rows.add_row(static_cast<int>(random.below(10)));
      expected.emplace_back();
    } else if (what == 1) {
      rows.drop_last_row();
      expected.pop_back();
    } else {
      const std::uint32_t row = random.below(expected.size());
      auto& vector = expected[row];
      if (what < 14 || vector.empty()) {
        const auto at = static_cast<int>(random.below(vector.size() + 1));
        rows.insert(row, at, k, static_cast<char>(k % 100));
        vector.insert(vector.begin() + at, k);
      } else {
        const auto at = static_cast<int>(random.below(vector.size()));
        rows.erase(row, at);
        vector.erase(vector.begin() + at);
      }
    }
    ASSERT_EQ(rows.count(), expected.size());
    for (std::size_t row = 0; row < expected.size(); ++row) {
      ASSERT_EQ(row_of<0>(rows, row), expected[row]);
      const auto letters = row_of<1>(rows, row);
      for (std::size_t x = 0; x < letters.size(); ++x) ASSERT_EQ(letters[x], expected[row][x] % 100);
    }
  }
}

TEST(SlackRowsOf, OneSizeUseTheRoomsOfRowsThatAreGone) {
  Rows rows;
  for (int k = 0; k < 10; ++k) rows.add_row(5);
  const std::size_t room = rows.column<0>().size();
  for (int k = 0; k < 10; ++k) rows.drop_last_row();
  for (int k = 0; k < 10; ++k) rows.add_row(5);
  EXPECT_EQ(room, 80u);  // five entries lie in a room of eight
  EXPECT_EQ(rows.column<0>().size(), room);
}

TEST(SlackRowsOf, ARowThatOutgrowsItsRoomLeaveItToAnother) {
  Rows rows;
  rows.add_row();
  for (int k = 0; k < 5; ++k) rows.insert(0, k, k, 'x');
  rows.add_row();
  EXPECT_EQ(rows.start(1), 0);
  EXPECT_EQ(row_of<0>(rows, 0), (std::vector{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace dartboard
