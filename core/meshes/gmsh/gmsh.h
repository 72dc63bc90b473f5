#pragma once

#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

/// Passes the contents of a Gmsh file of any version to a builder and returns the exact name of the format.
std::string read_gmsh(std::string_view text, MeshBuilder& builder);

}  // namespace dartboard
