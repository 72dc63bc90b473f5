#pragma once
// Meshes from and to files. Every error names file, line (or byte, or array) and expectation.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/meshes/formats/loaded_mesh.h"

namespace dartboard {

enum class MeshFormat { medit, tetgen, gmsh, vtk_legacy, vtu, stl, obj, ply, off };

/// A format as `dartboard mesh --formats` lists it, and as the reader finds it.
struct MeshFormatInfo {
  MeshFormat format;
  std::string_view name;
  std::span<const std::string_view> extensions;  // in small letters, with their points
  std::string_view read, written;                // the variants; `written` is empty if none is written
};

/// All formats that are read.
std::span<const MeshFormatInfo> mesh_formats();

/// Read and check the mesh in a file whose extension gives its format (mesh_formats). For TetGen either file, or the
/// stem of both, will do.
///
/// The cells are the volumes of the file, or its polygons if it has no volumes; elements of a lower dimension are
/// skipped, points of no cell are dropped, and inverted volumes are reordered, each with a notice. Cells are numbered
/// from 0 in the order of the file.
///
/// throws  IoError when the file cannot be read, is malformed, or is not a mesh by the rules of check_and_repair;
///         InputError as weld_points
LoadedMesh read_mesh_file(const std::filesystem::path& path, const MeshReading& reading = {});

/// The mesh alone, for a program that does not ask for notices, tags of cells and numbers of points.
Mesh read_mesh(const std::filesystem::path& path, const MeshReading& reading = {});

/// Reads a text in memory; `name` stands for the file in errors. A TetGen text is the .node file followed by
/// the .ele file.
LoadedMesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name,
                      const MeshReading& reading = {});

/// Write a mesh as Medit ASCII with 17 significant digits, so that reading it gives the same bits.
///
/// throws  IoError when the file exists already or cannot be written; InputError for an index out of range
void write_medit(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace dartboard
