#pragma once
// The event that takes cells apart at facets: faces of a solid, edges of a surface.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/scene/file/selections/selection.h"

namespace dartboard {

/// Facets, each by its points in the mesh.
using FacetPoints = std::vector<std::vector<std::uint32_t>>;

struct Dissociate {
  static constexpr std::string_view key = "dissociate";
  static constexpr bool changes_topology = true, dissociates = true;
  static Dissociate read(const SceneValue& value);

  // by the points around each; on a plane; or where a blade sweeps
  std::variant<FacetPoints, PlaneSelection, BladeSweep> faces;
  std::optional<CutRegion> within{};  // of the faces on a plane, only those with their centre there are cut

  template <class Self, class F>
  static void for_each_choice(Self& self, const std::string& path, F&& f) {
    if (auto* facets = std::get_if<FacetPoints>(&self.faces)) f(path + "/points", *facets);
  }
};

}  // namespace dartboard
