#pragma once
// One reader per format of VTK. Each hands what it finds to a builder and returns the exact name of the format.

#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

std::string read_vtk_legacy(std::string_view text, MeshBuilder& builder);
std::string read_vtu(std::string_view text, MeshBuilder& builder);
std::string read_vtp(std::string_view text, MeshBuilder& builder);
/// Reads the files of the pieces too, whose names count from the folder of the builder's file.
std::string read_pvtu(std::string_view text, MeshBuilder& builder);

/// Which cells of a .vtu file are read: all, or those that are no copies of cells of another piece.
enum class GhostCells { read, left_out };
/// Add what a .vtu file holds to what is there; returns how many cells were left out.
std::size_t add_vtu(std::string_view text, GhostCells ghosts, MeshBuilder& builder);

}  // namespace dartboard
