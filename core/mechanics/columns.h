#pragma once
// Columns of embeddings, and how each follows a topological change: declared once, for every loop over the columns.

#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace dartboard {

/// How an embedding adapts when its cell is dissociated (section 4.3).
enum class Adapts {
  duplicated,    // every part has the value of the cell
  recomputed,    // from the cells around each part, eq. (1)
  proportional,  // to a recomputed value
};

/// One column of `Owner`: a vector, or a variant that holds one of several or nothing.
template <class Owner, class Column>
struct EmbeddedColumn {
  std::string_view name;
  Column Owner::*values;
  Adapts adapts;
};
template <class Owner, class Column>
EmbeddedColumn(const char*, Column Owner::*, Adapts) -> EmbeddedColumn<Owner, Column>;

/// Visit the columns in a table: visit(vector, its row). A column that is empty has been left out.
template <class Owner, class Table, class Visit>
void for_each_column(Owner& owner, const Table& table, Visit&& visit) {
  const auto visit_rows = [&visit](auto& column, const auto& row) {
    const auto visit_if_any = [&]<class Rows>(Rows& rows) {
      if constexpr (!std::is_same_v<const Rows, const std::monostate>) visit(rows, row);
    };
    if constexpr (requires { column.index(); })
      std::visit(visit_if_any, column);
    else
      visit(column, row);
  };
  std::apply([&](const auto&... row) { (visit_rows(owner.*(row.values), row), ...); }, table);
}

/// Write or read every column in a table.
template <class Archive, class Owner, class Table>
void columns_state(Archive& archive, Owner& owner, const Table& table) {
  std::apply([&](const auto&... row) { archive(owner.*(row.values)...); }, table);
}

/// Append a part of element k: duplicated columns are copied, recomputed ones are left for the caller to fill.
template <class Owner, class Table>
void add_part_of_element(Owner& owner, const Table& table, std::size_t k) {
  for_each_column(owner, table, [k](auto& column, const auto& row) {
    if (column.empty()) return;
    column.emplace_back();
    if (row.adapts == Adapts::duplicated) column.back() = column[k];
  });
}

/// Put the last element in place k and drop the last.
template <class Owner, class Table>
void move_last_element(Owner& owner, const Table& table, std::size_t k) {
  for_each_column(owner, table, [k](auto& column, const auto&) {
    if (column.empty()) return;
    column[k] = column.back();
    column.pop_back();
  });
}

/// Append one element, to be filled; columns that are left out, whose size is not `size`, stay empty.
template <class Owner, class Table>
void add_element(Owner& owner, const Table& table, std::size_t size) {
  for_each_column(owner, table, [size](auto& column, const auto&) {
    if (column.size() == size) column.emplace_back();
  });
}

/// Copy the elements with these numbers to the end of another owner's columns.
template <class Owner, class Table, class Numbers>
void copy_elements(const Owner& from, Owner& to, const Table& table, const Numbers& numbers) {
  for_each_column(from, table, [&]<class Rows>(const Rows& column, const auto& row) {
    if (column.empty()) return;
    const auto append = [&](Rows& target) {
      for (const auto k : numbers) target.push_back(column[k]);
    };
    auto& target = to.*(row.values);
    if constexpr (requires { target.index(); })
      append(std::holds_alternative<Rows>(target) ? std::get<Rows>(target) : target.template emplace<Rows>());
    else
      append(target);
  });
}

}  // namespace dartboard
