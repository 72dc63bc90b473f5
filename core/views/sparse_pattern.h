#pragma once
// Where the entries of a system matrix are, one row and one column per vertex; it follows a topological change in
// place.

#include <cstdint>
#include <limits>
#include <span>

#include "core/views/slack_rows.h"
#include "core/views/spring_ends.h"

namespace dartboard {

/// The upper triangle, diagonal included, of the symmetric pattern in which two vertices that an edge joins have an
/// entry.
///
/// The arrays are those of CHOLMOD's unpacked form: a `cholmod_sparse` with nrow = ncol = `columns()`, p =
/// `column_start()`, nz = `column_length()`, i = `row_index()`, nzmax = `room()`, stype = 1, packed = 0, sorted = 1.
/// Columns lie apart and in any order, each with room to grow (slack_rows.h), so an edge comes or goes in one column;
/// the places between columns belong to none. Edges from a vertex to itself add nothing to the diagonal.
class SparsePattern {
 public:
  static constexpr std::uint32_t no_place = std::numeric_limits<std::uint32_t>::max();

  /// cost    O(edges), times the entries of a column at worst
  template <class Body>
  void rebuild(const Body& body) {
    ends_.rebuild(body);
    fill(body.vertices.size());
  }

  /// Follow what `adapt` reports; gives what `rebuild` would. Places may move.
  ///
  /// cost    O(entries in the columns of the changed edges), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    while (columns() < changed.vertex_count) add_column(0);
    ends_.apply(
        body, changed, [this](std::uint32_t, const SpringEnds& ends) { remove(ends); },
        [this](std::uint32_t, const SpringEnds& ends) { add(ends); });
    while (columns() > changed.vertex_count) drop_last_column();
  }

  std::size_t columns() const { return rows_.count(); }
  /// In the upper triangle with the diagonal.
  std::size_t entries() const { return entries_; }
  /// How long arrays by place are.
  std::size_t room() const { return row_index().size(); }

  std::span<const std::int32_t> column_start() const { return rows_.starts(); }
  std::span<const std::int32_t> column_length() const { return rows_.lengths(); }
  /// By place; ascending within a column, the diagonal last.
  std::span<const std::int32_t> row_index() const { return rows_.column<0>(); }
  /// By place: how many edges join the two vertices; 1 on the diagonal.
  std::span<const std::uint32_t> multiplicity() const { return rows_.column<1>(); }

  /// Where the entry of vertices a and b is, in either order; no_place if no edge joins them.
  ///
  /// cost    O(log(entries of the column))
  std::uint32_t place(std::uint32_t a, std::uint32_t b) const;

  /// Equal when the same entries have the same multiplicities; where they lie does not count.
  friend bool operator==(const SparsePattern& a, const SparsePattern& b);

  std::size_t bytes() const { return rows_.bytes() + ends_.bytes(); }

 private:
  using Rows = SlackRows<std::int32_t, std::uint32_t>;

  void fill(std::size_t vertex_count);
  void add_column(Rows::Index neighbours);
  void drop_last_column();
  void add(const SpringEnds& ends);
  void remove(const SpringEnds& ends);
  /// Before which entry of column `column` row `row` belongs.
  Rows::Index position(std::uint32_t row, std::uint32_t column) const;

  SpringEndsView ends_;  // as the columns have them
  Rows rows_;            // a row of these is a column of the matrix
  std::size_t entries_ = 0;
};

}  // namespace dartboard
