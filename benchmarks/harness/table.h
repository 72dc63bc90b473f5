#pragma once
// A small table of text.

#include <string>
#include <vector>

namespace dartboard {

enum class Align { left, right };

struct Column {
  std::string title;
  Align align = Align::left;
};

/// Cells are UTF-8; every row has one cell per column.
class Table {
 public:
  /// throws  InputError without a column
  explicit Table(std::vector<Column> columns);

  /// throws  InputError unless there is one cell per column
  void add_row(std::vector<std::string> cells);

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// A table of a report; the braces allow members to be left out.
struct NamedTable {
  std::string name{}, heading{};  // "frequencies", "Highest frequencies of meshes, by Lanczos"
  Table table;
  std::string note{};    // below it
  std::string study{};   // the study it belongs to, where a report has several: "limits"
  bool on_page = false;  // alone: too long for a terminal
};

/// Columns two spaces apart, under a ruled header; line breaks within a cell become spaces.
std::string to_text(const Table& table);

}  // namespace dartboard
