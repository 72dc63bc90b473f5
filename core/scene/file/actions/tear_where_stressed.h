#pragma once
// The event that tears wherever the stress is too large.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/file/selections/selection.h"

namespace dartboard {

struct TearWhereStressed {
  static constexpr std::string_view key = "tear_where_stressed";
  static constexpr bool changes_topology = true, dissociates = true;
  static TearWhereStressed read(const SceneValue& value);

  double threshold;                    // [Pa]
  std::optional<PlaneSelection> seam;  // through the body at rest
  std::optional<std::size_t> most_per_step;

  template <class Self, class F>
  static void for_each_choice(Self&, const std::string&, F&&) {}
};

}  // namespace dartboard
