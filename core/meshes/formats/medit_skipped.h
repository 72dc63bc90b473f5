#pragma once
// The sections of a Medit text of which nothing is kept: marks of edges and points, normals, solutions, associations
// with a geometry. libMeshb, Mmg and bamg write them.

#include <cstdint>
#include <string_view>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// The sizes that the length of a section may depend on.
struct MeditSizes {
  std::uint64_t dimension, vertices;
};

/// Skip the section whose keyword was read; false, and nothing is taken, when it is not one of these.
///
/// throws  IoError when the section is shorter than it announces
bool skip_medit_section(TextScanner& scan, std::string_view keyword, const MeditSizes& sizes);

}  // namespace dartboard
