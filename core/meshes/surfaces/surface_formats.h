#pragma once
// One reader per format of surfaces. Each passes its contents to a builder and returns the exact name of the format.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

/// Corners with equal coordinates become one point: the format has no point numbers.
std::string read_stl(std::string_view text, MeshBuilder& builder);
std::string read_obj(std::string_view text, MeshBuilder& builder);
std::string read_ply(std::string_view text, MeshBuilder& builder);
std::string read_off(std::string_view text, MeshBuilder& builder);

/// Add a triangle or a quadrilateral.
///
/// throws  IoError for a polygon of another size
void add_polygon(MeshBuilder& builder, std::span<const std::uint64_t> corners, std::size_t line);

}  // namespace dartboard
