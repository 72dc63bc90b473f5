#pragma once
// The darts and alphas of a map as plain numbers, for a witness that knows no map.

#include "core/topology/generalized_map.h"
#include "reference/dart_table.h"

namespace dartboard {

template <class Map>
reference::DartTable dart_table_of(const Map& map) {
  reference::DartTable table;
  table.alpha.assign(Map::dimension + 1, std::vector<std::uint32_t>(map.capacity(), reference::DartTable::no_dart));
  map.for_each_dart([&](Dart d) {
    for (int i = 0; i <= Map::dimension; ++i) table.alpha[static_cast<std::size_t>(i)][d.index] = map.alpha(i, d).index;
  });
  return table;
}

}  // namespace dartboard
