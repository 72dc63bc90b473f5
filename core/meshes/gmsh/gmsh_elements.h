#pragma once
// The element types of Gmsh, the same in all versions of its format.

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/plain/mesh.h"

namespace dartboard {

struct GmshElement {
  std::uint64_t type;
  int dimension;
  int nodes;
  std::string_view name;
  std::optional<CellKind> kind;  // no value for points and edges; its corners come first among the nodes

  bool is_first_order() const { return !kind || nodes == node_count(*kind); }
};

/// The element of this type number, or nullptr for the rarer ones that a mesh here cannot hold.
const GmshElement* gmsh_element(std::uint64_t type);

}  // namespace dartboard
