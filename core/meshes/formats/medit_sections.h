#pragma once
// The sections of a Medit file that hold cells, for its text and its binary variant.

#include <cstdint>
#include <string>
#include <string_view>

#include "core/plain/mesh.h"

namespace dartboard {

struct MeditSection {
  std::string_view keyword;
  std::int64_t code;  // in the binary variant
  CellKind kind;
  int nodes;                      // corners first
  std::string_view element = {};  // of higher order

  std::string called() const { return std::string(element.empty() ? name(kind) : element); }
};

/// nullptr for a section of anything else; the keyword may be in any case.
const MeditSection* medit_section(std::string_view keyword);
const MeditSection* medit_section(std::int64_t code);

}  // namespace dartboard
