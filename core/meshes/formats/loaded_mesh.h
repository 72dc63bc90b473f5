#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// A checked mesh of one dimension, and in plain sentences whatever was skipped, dropped or repaired on the way.
struct LoadedMesh {
  Mesh mesh;
  std::string format;  // as read: "Gmsh MSH 2.2"
  std::vector<std::string> notices;
  std::vector<std::uint32_t> place_of_point;  // of each point of the file in `mesh`; empty where none is dropped
  static constexpr std::uint32_t dropped = 0xFFFFFFFF;  // a point of no cell has none
};

}  // namespace dartboard
