#pragma once
// The event that releases vertices held still.

#include <string>
#include <string_view>

#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct Release {
  static constexpr std::string_view key = "release";
  static constexpr bool changes_topology = false, dissociates = false;
  static Release read(const SceneValue& value) { return {read_vertices(value)}; }

  VertexSelection vertices;  // by rest position

  template <class Self, class F>
  static void for_each_choice(Self& self, const std::string& path, F&& f) {
    f(path, self.vertices);
  }
};

}  // namespace dartboard
