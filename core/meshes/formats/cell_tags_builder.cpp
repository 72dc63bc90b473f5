#include "core/meshes/formats/cell_tags_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {

std::size_t CellTagsBuilder::column(std::string_view name, bool zero_is_none) {
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].name == name) return k;
  columns_.push_back({.name = std::string(name), .zero_is_none = zero_is_none});
  return columns_.size() - 1;
}

void CellTagsBuilder::set(std::size_t column, std::size_t cell, std::int64_t value) {
  auto& values = columns_[column].values;
  if (values.size() <= cell) values.resize(cell + 1, 0);
  values[cell] = value;
}

std::int64_t CellTagsBuilder::value(std::size_t column, std::size_t cell) const { return columns_[column].value(cell); }

void CellTagsBuilder::name_value(std::size_t column, int dimension, std::int64_t value, std::string name) {
  columns_[column].names.insert_or_assign({dimension, value}, std::move(name));
}

std::vector<CellTags> CellTagsBuilder::finish(std::span<const std::uint32_t> cells, int dimension,
                                              std::vector<std::string>& notices) const {
  using Limits = std::numeric_limits<std::int32_t>;
  std::vector<CellTags> finished;
  for (const Column& column : columns_) {
    CellTags tags{.name = column.name, .values = {}, .names = {}};
    tags.values.reserve(cells.size());
    std::int64_t beyond = 0;
    for (const std::uint32_t cell : cells) {
      const std::int64_t value = column.value(cell);
      if (value < Limits::min() || value > Limits::max()) beyond = value;
      tags.values.push_back(static_cast<std::int32_t>(value));
    }
    if (beyond != 0) {
      notices.push_back(
          fmt::format("left out {} of the cells: {} does not fit in 32 bits", in_quotes(column.name), beyond));
      continue;
    }
    if (column.zero_is_none && std::ranges::count(tags.values, 0) == std::ssize(tags.values)) continue;
    for (const auto& [key, name] : column.names)
      if (key.first == dimension && key.second >= Limits::min() && key.second <= Limits::max())
        tags.names.emplace(static_cast<std::int32_t>(key.second), name);
    finished.push_back(std::move(tags));
  }
  return finished;
}

}  // namespace dartboard
