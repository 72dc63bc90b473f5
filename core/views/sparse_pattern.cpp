#include "core/views/sparse_pattern.h"

#include <algorithm>

namespace dartboard {

SparsePattern::Rows::Index SparsePattern::position(std::uint32_t row, std::uint32_t column) const {
  const auto first = rows_.column<0>().begin() + rows_.start(column), end = first + rows_.length(column);
  return static_cast<Rows::Index>(std::lower_bound(first, end, static_cast<std::int32_t>(row)) - first);
}

std::uint32_t SparsePattern::place(std::uint32_t a, std::uint32_t b) const {
  const auto [row, column] = std::minmax(a, b);
  const Rows::Index at = position(row, column);
  const auto place = static_cast<std::uint32_t>(rows_.start(column) + at);
  return at < rows_.length(column) && row_index()[place] == static_cast<std::int32_t>(row) ? place : no_place;
}

void SparsePattern::add_column(Rows::Index neighbours) {
  const auto column = static_cast<std::int32_t>(columns());
  rows_.add_row(neighbours + 1);
  rows_.insert(columns() - 1, 0, column, 1u);
  ++entries_;
}

void SparsePattern::drop_last_column() {
  entries_ -= static_cast<std::size_t>(rows_.length(columns() - 1));
  rows_.drop_last_row();
}

void SparsePattern::add(const SpringEnds& ends) {
  const auto [row, column] = std::minmax(ends[0], ends[1]);
  if (row == column) return;
  const Rows::Index at = position(row, column);  // before the end: the diagonal is the last entry
  const auto place = static_cast<std::size_t>(rows_.start(column) + at);
  if (row_index()[place] == static_cast<std::int32_t>(row)) {
    ++rows_.column<1>()[place];
  } else {
    rows_.insert(column, at, static_cast<std::int32_t>(row), 1u);
    ++entries_;
  }
}

void SparsePattern::remove(const SpringEnds& ends) {
  const auto [row, column] = std::minmax(ends[0], ends[1]);
  if (row == column) return;
  const Rows::Index at = position(row, column);
  if (--rows_.column<1>()[static_cast<std::size_t>(rows_.start(column) + at)] > 0) return;
  rows_.erase(column, at);
  --entries_;
}

void SparsePattern::fill(std::size_t vertex_count) {
  std::vector<Rows::Index> neighbours(vertex_count, 0);
  for (const SpringEnds& ends : ends_.ends) ++neighbours[std::max(ends[0], ends[1])];
  rows_.clear();
  entries_ = 0;
  for (const auto n : neighbours) add_column(n);
  for (const SpringEnds& ends : ends_.ends) add(ends);
}

bool operator==(const SparsePattern& a, const SparsePattern& b) {
  if (a.columns() != b.columns() || a.entries_ != b.entries_ || a.ends_ != b.ends_) return false;
  for (std::size_t column = 0; column < a.columns(); ++column) {
    if (a.rows_.length(column) != b.rows_.length(column)) return false;
    const auto here = a.rows_.start(column), there = b.rows_.start(column), length = a.rows_.length(column);
    const auto same = [here, there, length](const auto& x, const auto& y) {
      return std::equal(x.begin() + here, x.begin() + here + length, y.begin() + there);
    };
    if (!same(a.rows_.column<0>(), b.rows_.column<0>()) || !same(a.rows_.column<1>(), b.rows_.column<1>()))
      return false;
  }
  return true;
}

}  // namespace dartboard
