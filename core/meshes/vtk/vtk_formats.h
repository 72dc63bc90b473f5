#pragma once
// One reader per format of VTK. Each passes its contents to a builder and returns the exact name of the format.

#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder);
std::string read_vtu(std::string_view text, MeshBuilder& builder);

}  // namespace dartboard
