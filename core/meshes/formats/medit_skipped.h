#pragma once
// The sections of a Medit text of which nothing is kept: marks of edges and points, normals, solutions, associations
// with a geometry. libMeshb, Mmg and bamg write them.

#include <cstdint>
#include <string_view>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {

/// What the length of a section may depend on.
struct MeditSizes {
  std::uint64_t dimension, vertices;
};

/// Pass over the section whose keyword was read; false, and nothing is taken, when it is none of these.
///
/// throws  IoError when the section ends before what it announces
bool skip_medit_section(TextScanner& scan, std::string_view keyword, const MeditSizes& sizes);

}  // namespace dartboard
