#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// What a file says of each cell in whole numbers: a material, the region that it belongs to.
struct CellTags {
  std::string name;                           // "reference" (Medit), "physical group" (Gmsh), or as the file calls it
  std::vector<std::int32_t> values;           // by cell of the mesh
  std::map<std::int32_t, std::string> names;  // of the values that the file has a name for
};

/// A checked mesh of one dimension, and in plain sentences whatever was skipped, dropped or repaired on the way.
struct LoadedMesh {
  Mesh mesh;
  std::string format;  // as read: "Gmsh MSH 2.2"
  std::vector<std::string> notices;
  std::vector<std::uint32_t> place_of_point;  // of each point of the file in `mesh`; empty where none is dropped
  std::vector<std::uint32_t>
      file_number;  // of each point of `mesh`: its number in the file; empty where that is its own
  std::vector<CellTags> tags = {};
  static constexpr std::uint32_t dropped = 0xFFFFFFFF;  // a point of no cell has none
};

}  // namespace dartboard
