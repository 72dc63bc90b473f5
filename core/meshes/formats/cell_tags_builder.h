#pragma once
// Whole numbers that a file gives its cells, collected together with the cells.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/meshes/formats/loaded_mesh.h"

namespace dartboard {

/// Columns of numbers, each with a name; a cell without a number in a column has 0.
class CellTagsBuilder {
 public:
  /// The place of the column of this name, which is made when it does not exist. If zero means "none", a column of
  /// zeros is dropped.
  std::size_t column(std::string_view name, bool zero_is_none);
  void set(std::size_t column, std::size_t cell, std::int64_t value);
  std::int64_t value(std::size_t column, std::size_t cell) const;
  /// Set the name of a value for cells of a dimension.
  void name_value(std::size_t column, int dimension, std::int64_t value, std::string name);

  /// The columns for the cells of a mesh, given by their places among all cells. A column with a number that does not
  /// fit in 32 bits is left out with a notice.
  std::vector<CellTags> finish(std::span<const std::uint32_t> cells, int dimension,
                               std::vector<std::string>& notices) const;

 private:
  struct Column {
    std::string name;
    bool zero_is_none;
    std::vector<std::int64_t> values = {};
    std::map<std::pair<int, std::int64_t>, std::string> names = {};

    std::int64_t value(std::size_t cell) const { return cell < values.size() ? values[cell] : 0; }
  };

  std::vector<Column> columns_;
};

}  // namespace dartboard
