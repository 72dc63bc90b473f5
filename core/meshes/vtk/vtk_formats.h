#pragma once
// One reader per format of VTK. Each passes its contents to a builder and returns the exact name of the format.

#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder);
std::string read_vtu(std::string_view text, MeshBuilder& builder);
std::string read_vtp(std::string_view text, MeshBuilder& builder);
/// Reads the files of the pieces too, whose names count from the folder of the builder's file.
std::string read_pvtu(std::string_view text, MeshBuilder& builder);

/// Add the contents of a .vtu file to those of the builder.
void add_vtu(std::string_view text, MeshBuilder& builder);

}  // namespace dartboard
