#include "benchmarks/harness/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/base/escape.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

/// Code points of UTF-8 text: its width on a terminal for every alphabet that the reports use.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

constexpr std::size_t longest_cell = 400;  // letters

std::string text_cell(const std::string& cell) {
  std::string line = cell;
  std::ranges::replace(line, '\n', ' ');
  return terminal_text(shortened(line, longest_cell));
}

std::string padded(const std::string& cell, std::size_t to, Align align) {
  const std::string blank(to - std::min(to, width(cell)), ' ');
  return align == Align::left ? cell + blank : blank + cell;
}

/// The table as it is printed: cells rewritten, the header first, with the width of each column.
struct Layout {
  std::vector<std::vector<std::string>> lines;
  std::vector<std::size_t> widths;
};

Layout layout(const Table& table) {
  Layout result;
  std::vector<std::string> header;
  for (const Column& column : table.columns()) header.push_back(text_cell(column.title));
  result.lines.push_back(std::move(header));
  for (const auto& row : table.rows()) {
    auto& line = result.lines.emplace_back();
    for (const std::string& cell : row) line.push_back(text_cell(cell));
  }
  result.widths.assign(table.columns().size(), 0);
  for (const auto& line : result.lines)
    for (std::size_t c = 0; c < line.size(); ++c) result.widths[c] = std::max(result.widths[c], width(line[c]));
  return result;
}

}  // namespace

Table::Table(std::vector<Column> columns) : columns_(std::move(columns)) {
  if (columns_.empty()) throw InputError("a table needs a column");
}

void Table::add_row(std::vector<std::string> cells) {
  if (cells.size() != columns_.size())
    throw InputError(fmt::format("a row of {} cells in a table of {} columns", cells.size(), columns_.size()));
  rows_.push_back(std::move(cells));
}

std::string to_text(const Table& table) {
  const Layout made = layout(table);
  std::string text;
  const auto add_line = [&](std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  for (const auto& cells : made.lines) {
    std::string line, rule;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string gap = c == 0 ? "" : "  ";
      line += gap + padded(cells[c], made.widths[c], table.columns()[c].align);
      rule += gap + std::string(made.widths[c], '-');
    }
    add_line(line);
    if (&cells == &made.lines.front()) add_line(rule);
  }
  return text;
}

}  // namespace dartboard
