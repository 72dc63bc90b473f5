#pragma once
// One reader per format of volumes; Gmsh and VTK have folders of their own. Each passes its contents to a builder and
// returns the exact name of the format.

#include <string>
#include <string_view>

#include "core/meshes/formats/mesh_builder.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// Text or bytes, decided by the beginning of the file.
std::string read_medit(std::string_view text, MeshBuilder& builder);
std::string read_medit_binary(std::string_view text, MeshBuilder& builder);
/// The builder's point file is `node`'s and its cell file is `ele`'s; both may be one scanner over one text.
std::string read_tetgen(TextScanner& node, TextScanner& ele, MeshBuilder& builder);

}  // namespace dartboard
