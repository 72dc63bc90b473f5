#pragma once
// Tables in the form that tests compare: each cell under its heading, so that a misplaced one shows.

#include <string>
#include <vector>

#include "benchmarks/harness/table.h"

namespace dartboard {

using Row = std::vector<std::string>;

/// "heading: cell" of each column.
inline Row labelled(const Table& table, std::size_t row) {
  Row cells;
  for (std::size_t k = 0; k < table.columns().size(); ++k)
    cells.push_back(table.columns()[k].title + ": " + table.rows().at(row).at(k));
  return cells;
}

/// One letter for each column: 'l' if it is aligned to the left, as words are, 'r' if to the right, as numbers.
inline std::string alignment(const Table& table) {
  std::string letters;
  for (const Column& column : table.columns()) letters += column.align == Align::left ? 'l' : 'r';
  return letters;
}

}  // namespace dartboard
