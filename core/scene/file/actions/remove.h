#pragma once
// The event that removes cells.

#include <string>
#include <string_view>

#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct Remove {
  static constexpr std::string_view key = "remove";
  static constexpr bool changes_topology = true, dissociates = false;
  static Remove read(const SceneValue& value) { return {read_cells(value)}; }

  CellSelection cells;

  template <class Self, class F>
  static void for_each_choice(Self& self, const std::string& path, F&& f) {
    f(path, self.cells);
  }
};

}  // namespace dartboard
