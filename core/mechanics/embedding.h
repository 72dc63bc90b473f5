#pragma once
// Embeddings: information attached to cells through their darts (section 2.2).

#include <cstdint>
#include <limits>
#include <vector>

#include "core/topology/cells.h"

namespace dartboard {

/// The darts of an orbit that store the embedding of their cell: "the same information to all the darts of the orbit or
/// to a single dart" (section 2.2; the paper chose the second).
enum class Held { by_one_dart, by_every_dart };

inline constexpr std::uint32_t no_embedding = std::numeric_limits<std::uint32_t>::max();

/// The number of the embedding of each i-cell; the embeddings themselves are columns that this number indexes.
///
/// cost    a look-up walks the orbit when one dart holds the number, and reads one place when every dart does
template <int i, class Map, Held held>
class CellEmbedding {
 public:
  /// Make `number` the embedding of `cell`.
  void attach(const Map& map, Cell<i> cell, std::uint32_t number) {
    at_.resize(map.template slot_count<i>(), no_embedding);
    // where one dart holds the number, the others lose the cell's earlier one
    const std::uint32_t others = held == Held::by_every_dart ? number : no_embedding;
    for_each_dart_of(map, cell, [&](Dart d) { at_[Map::template slot<i>(d)] = others; });
    at_[Map::template slot<i>(cell.dart)] = number;
  }

  /// Attaches a number to a cell whose places, one dart for each slot<i>, are known (for_each_place_of).
  template <class Darts>
  void attach_places(const Map& map, const Darts& places, std::uint32_t number) {
    static_assert(held == Held::by_every_dart);
    if (at_.size() < map.template slot_count<i>()) at_.resize(map.template slot_count<i>(), no_embedding);
    for (const Dart d : places) at_[Map::template slot<i>(d)] = number;
  }

  /// The embedding of the i-cell of d; no_embedding if it has none.
  std::uint32_t operator()(const Map& map, Dart d) const {
    if constexpr (held == Held::by_every_dart) {
      return number_at(d);
    } else {
      std::uint32_t number = number_at(d);
      if (number != no_embedding) return number;
      for_each_dart_of(map, Cell<i>{d}, [&](Dart e) {
        number = number_at(e);
        return number != no_embedding;
      });
      return number;
    }
  }

  std::size_t bytes() const { return at_.capacity() * sizeof(std::uint32_t); }
  template <class Archive>
  void state(Archive& archive) {
    archive(at_);
  }

 private:
  // Darts born after the last `attach` have no place yet.
  std::uint32_t number_at(Dart d) const {
    const std::uint32_t slot = Map::template slot<i>(d);
    return slot < at_.size() ? at_[slot] : no_embedding;
  }

  std::vector<std::uint32_t> at_;  // by slot<i>
};

}  // namespace dartboard
