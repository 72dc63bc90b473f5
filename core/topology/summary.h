#pragma once
// Numbers that describe a map: cells, components, boundary, Euler characteristic, orientability, validity.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/topology/generalized_map.h"

namespace dartboard {

/// Connected components: a label per dart slot (in the order of their lowest darts), and the number of components.
struct Components {
  std::vector<std::uint32_t> of_dart;  // by dart slot; undefined for dead slots
  std::size_t count = 0;
};
template <class Map>
Components components(const Map& map);

/// A sign per dart slot, +1 or -1, that every alpha_i(d) != d changes; no value if the map has no such orientation.
template <class Map>
std::optional<std::vector<signed char>> orientation(const Map& map);

/// The summary that `mesh info` prints; `cells[i]` counts the i-cells.
struct MapSummary {
  int dimension = 0;
  std::size_t darts = 0;
  std::vector<std::size_t> cells;
  std::size_t components = 0;
  std::size_t boundary_facets =
      0;           // (n-1)-cells with one n-cell: boundary faces of a solid, boundary edges of a surface
  long euler = 0;  // sum of (-1)^i cells[i]
  bool orientable = true;
  std::string violation;  // of check(map); empty for a valid map
};
template <class Map>
MapSummary summarize(const Map& map);

extern template Components components(const Map2&);
extern template Components components(const Map3&);
extern template Components components(const TetMap&);
extern template std::optional<std::vector<signed char>> orientation(const Map2&);
extern template std::optional<std::vector<signed char>> orientation(const Map3&);
extern template std::optional<std::vector<signed char>> orientation(const TetMap&);
extern template MapSummary summarize(const Map2&);
extern template MapSummary summarize(const Map3&);
extern template MapSummary summarize(const TetMap&);

}  // namespace dartboard
