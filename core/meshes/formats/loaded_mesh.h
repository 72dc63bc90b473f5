#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/meshes/formats/crossed_cells.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// The whole numbers that a file gives each cell: a material, the region that it belongs to.
struct CellTags {
  std::string name;                           // "reference" (Medit), "physical group" (Gmsh), or the name in the file
  std::vector<std::int32_t> values;           // by cell of the mesh
  std::map<std::int32_t, std::string> names;  // of the values that the file has a name for
};

/// The options for reading a mesh.
struct MeshReading {
  std::optional<double> weld{};  // [units of the file] points at most so far apart become one
  bool keep_crossed = false;     // cells that cross themselves are listed, and not refused
};

/// A checked mesh of one dimension, and notices in plain sentences of all that was skipped, dropped or repaired.
struct LoadedMesh {
  Mesh mesh;
  std::string format;  // as read: "Gmsh MSH 2.2"
  std::vector<std::string> notices;
  std::vector<std::uint32_t> place_of_point;  // of each point of the file in `mesh`; empty if all have kept theirs
  std::vector<CellTags> tags = {};
  std::vector<std::uint32_t> copied = {};  // of each point after those of the file: the point that it is a copy of
  CrossedCells crossed = {};               // where MeshReading keeps them
  static constexpr std::uint32_t dropped = 0xFFFFFFFF;  // the place of a point of no cell

  /// The number in the file, counted from 0, of a point of `mesh`. Welded points have the lowest number of their group;
  /// a copy has that of its original.
  std::size_t number_in_file(std::uint32_t point) const;
  /// These numbers for all points of `mesh`; empty where each is the point's own.
  std::vector<std::uint32_t> numbers_in_file() const;
};

}  // namespace dartboard
