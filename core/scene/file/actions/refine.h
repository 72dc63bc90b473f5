#pragma once
// The event that subdivides tetrahedra.

#include <string>
#include <string_view>

#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct Refine {
  static constexpr std::string_view key = "refine";
  static constexpr bool changes_topology = true, dissociates = false;
  /// throws  InputError for a bracing in a body without springs
  static Refine read(const SceneValue& value, bool has_springs);

  CellSelection cells;
  bool at_centre;  // false: in the longest edge
  double bracing;

  template <class Self, class F>
  static void for_each_choice(Self& self, const std::string& path, F&& f) {
    f(path + "/cells", self.cells);
  }
};

}  // namespace dartboard
