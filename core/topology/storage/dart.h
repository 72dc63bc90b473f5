#pragma once
// Darts and cells: the handles of a generalized map. This file stands alone.

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace dartboard {

/// A dart: "a vertex on an edge of a face of a volume of the object" (section 2.1), as a slot number of its map.
struct Dart {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  friend constexpr auto operator<=>(Dart, Dart) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(index);
  }
};

/// No dart at all: the value of a default-constructed Dart. (An i-free dart is its own alpha_i instead.)
inline constexpr Dart no_dart{};

/// A dart that survives edits: resolving it after the dart died is an error, also when its slot has been used again.
struct DartId {
  Dart dart;
  std::uint32_t generation = 0;
  friend constexpr bool operator==(DartId, DartId) = default;
};

/// The i-cell that `dart` belongs to. Cells of different dimensions are different types.
template <int i>
struct Cell {
  static constexpr int dimension = i;
  Dart dart;
};
using Vertex = Cell<0>;
using Edge = Cell<1>;
using Face = Cell<2>;
using Volume = Cell<3>;

/// "d17", or "no dart".
inline std::string to_string(Dart d) { return d == no_dart ? "no dart" : "d" + std::to_string(d.index); }

}  // namespace dartboard

template <>
struct std::hash<dartboard::Dart> {
  std::size_t operator()(dartboard::Dart d) const noexcept { return d.index; }
};
