#pragma once
// Rows of varying length in one array, each with room to grow: what views of neighbours are kept in.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {

/// Rows of entries, an entry being one value of each of `Columns`; every column is one array for all the rows.
///
/// A row lies in a room of 4, 8, 16, ... entries. One that outgrows its room moves to another of twice the size, and
/// rooms left behind are given out again, so nothing is ever compacted and no call costs more than the row it changes:
/// a compaction would now and then cost a step of the simulation as much as the whole body is large. No more rooms of a
/// size exist than were in use at once.
template <class... Columns>
class SlackRows {
 public:
  using Index = std::int32_t;  // that of CHOLMOD

  std::size_t count() const { return length_.size(); }
  Index start(std::size_t row) const { return start_[row]; }
  Index length(std::size_t row) const { return length_[row]; }
  /// By row, and one more that means nothing: CHOLMOD allocates it too.
  const std::vector<Index>& starts() const { return start_; }
  const std::vector<Index>& lengths() const { return length_; }
  template <std::size_t c>
  const auto& column() const {
    return std::get<c>(columns_);
  }
  template <std::size_t c>
  auto& column() {
    return std::get<c>(columns_);
  }

  void clear() {
    start_.assign(1, 0);
    length_.clear();
    room_.clear();
    for (auto& rooms : free_) rooms.clear();
    std::apply([](auto&... column) { (column.clear(), ...); }, columns_);
  }
  /// An empty row with room for `entries` or more.
  void add_row(Index entries = 0) {
    std::uint8_t room = 0;
    while (room_size(room) < entries) ++room;
    start_.back() = take(room);
    start_.push_back(0);
    length_.push_back(0);
    room_.push_back(room);
  }
  void drop_last_row() {
    start_.pop_back();
    free_[room_.back()].push_back(start_.back());
    length_.pop_back();
    room_.pop_back();
  }
  /// Put an entry before the one at `position` of the row.
  void insert(std::size_t row, Index position, const Columns&... values) {
    if (length_[row] == room_size(room_[row])) grow(row);
    const Index at = start_[row] + position, end = start_[row] + length_[row]++;
    for_each_column(
        [at, end](auto& column, const auto& value) {
          std::move_backward(column.begin() + at, column.begin() + end, column.begin() + end + 1);
          column[static_cast<std::size_t>(at)] = value;
        },
        std::index_sequence_for<Columns...>{}, values...);
  }
  void erase(std::size_t row, Index position) {
    const Index at = start_[row] + position, end = start_[row] + length_[row]--;
    std::apply(
        [at, end](auto&... column) {
          (std::move(column.begin() + at + 1, column.begin() + end, column.begin() + at), ...);
        },
        columns_);
  }

  std::size_t bytes() const {
    std::size_t total = sizeof(Index) * (start_.capacity() + length_.capacity()) + room_.capacity();
    for (const auto& rooms : free_) total += sizeof(Index) * rooms.capacity();
    std::apply([&total](const auto&... column) { ((total += sizeof(*column.data()) * column.capacity()), ...); },
               columns_);
    return total;
  }

 private:
  static Index room_size(std::uint8_t room) { return Index{4} << room; }

  template <class F, std::size_t... c>
  void for_each_column(F&& f, std::index_sequence<c...>, const Columns&... values) {
    (f(std::get<c>(columns_), values), ...);
  }
  Index take(std::uint8_t room) {
    if (!free_[room].empty()) {
      const Index start = free_[room].back();
      free_[room].pop_back();
      return start;
    }
    const std::size_t start = std::get<0>(columns_).size(), end = start + static_cast<std::size_t>(room_size(room));
    if (end > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      throw InputError("the body has too many edges for rows numbered with 32 bits");
    std::apply([end](auto&... column) { (column.resize(end), ...); }, columns_);
    return static_cast<Index>(start);
  }
  void grow(std::size_t row) {
    const Index from = start_[row], to = take(static_cast<std::uint8_t>(room_[row] + 1));
    std::apply([this, row, from,
                to](auto&... column) { (std::copy_n(column.begin() + from, length_[row], column.begin() + to), ...); },
               columns_);
    free_[room_[row]++].push_back(from);
    start_[row] = to;
  }

  std::vector<Index> start_{0}, length_;     // by row
  std::vector<std::uint8_t> room_;           // by row: it has room for 4 << room entries
  std::array<std::vector<Index>, 30> free_;  // by kind of room
  std::tuple<std::vector<Columns>...> columns_;
};

}  // namespace dartboard
