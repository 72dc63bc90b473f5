#pragma once
// The cells of a selection, found in a body that changes.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/archive.h"
#include "core/base/bytes.h"
#include "core/mechanics/element_nodes.h"
#include "core/places/border.h"
#include "core/plain/random.h"
#include "core/scene/body/events/on_darts.h"

namespace dartboard {

/// The mean of the positions of the vertices of cell k [m].
template <class Map>
Eigen::Vector3d centroid_of(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k) {
  Eigen::Vector3d sum(0, 0, 0);
  double count = 0.0;
  const auto add = [&](Dart d) {
    sum += body.vertices.position[body.vertex(body.map, d)];
    count += 1.0;
  };
  if constexpr (Map::tetrahedral) {  // the same corners in the same order, without a walk
    for (const Dart d : corners_from(body.map, body.cell_dart[k])) add(d);
  } else {
    for (const Vertex v : incident_cells<0>(body.map, Cell<Map::dimension>{body.cell_dart[k]})) add(v.dart);
  }
  return sum / count;
}

/// Finds the cells of a selection, by their present numbers, at each call.
template <class Map>
class CellChooser {
 public:
  CellChooser(const ChangingBody<Map>& on, const CellSelection& selection, const std::string& path)
      : on_(on), selection_(selection) {
    if (std::holds_alternative<TagSelection>(selection))
      refuse_event(path + "/tag", "has not been looked up", "cells of a scene whose mesh was loaded (load_mesh)");
    if (const auto* random = std::get_if<RandomSelection>(&selection)) random_.emplace(random->seed);
    if (const auto* by_id = std::get_if<IdSelection>(&selection)) {
      const auto& numbers = on.mesh_cell();
      const std::uint32_t end = numbers.empty() ? 0 : *std::ranges::max_element(numbers) + 1;
      for (std::size_t k = 0; k < by_id->ids.size(); ++k)
        if (by_id->ids[k] >= end)
          refuse_event(fmt::format("{}/ids/{}", path, k), fmt::format("is {}", by_id->ids[k]),
                       fmt::format("a cell of the mesh, less than {}", end));
      ids_.insert(by_id->ids.begin(), by_id->ids.end());
    }
  }

  /// The numbers of the cells, ascending.
  std::vector<std::uint32_t> choose() {
    const auto count = static_cast<std::uint32_t>(on_.body().cell_dart.size());
    if (random_) return draw(count, std::get<RandomSelection>(selection_).count);
    std::vector<std::uint32_t> cells;
    if (ids_.empty()) {
      std::vector<Eigen::Vector3d> centroids(count);
      for (std::uint32_t k = 0; k < count; ++k) centroids[k] = centroid_of(on_.body(), k);
      return cells_in(selection_, centroids, border_thickness(on_.body().vertices.position));
    }
    const std::span<const std::uint32_t> mesh_cell = on_.mesh_cell();
    for (std::uint32_t k = 0; k < count; ++k)
      if (ids_.contains(mesh_cell[k])) cells.push_back(k);
    return cells;
  }

  void state(Archive& archive) {
    if (random_) archive(*random_);
  }
  std::size_t bytes() const {
    const auto* by_id = std::get_if<IdSelection>(&selection_);
    return by_id == nullptr ? 0 : bytes_of(by_id->ids) + ids_.size() * sizeof(std::uint32_t);
  }

 private:
  /// The first places of a shuffle of 0 .. count - 1 (Fisher and Yates).
  std::vector<std::uint32_t> draw(std::uint32_t count, std::uint32_t wanted) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::uint32_t size = std::min(count, wanted);
    for (std::uint32_t k = 0; k < size; ++k) std::swap(numbers[k], numbers[k + random_->below(count - k)]);
    numbers.resize(size);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  const ChangingBody<Map>& on_;
  CellSelection selection_;
  std::unordered_set<std::uint32_t> ids_;  // of the mesh; empty for a selection by place
  std::optional<SplitMix64> random_;
};

}  // namespace dartboard
