#include "core/scene/survey/selection_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <variant>

#include "core/base/overloads.h"
#include "core/places/border.h"
#include "core/scene/file/force_kind.h"
#include "core/scene/file/scene_materials.h"

namespace dartboard {
namespace {

/// Counts in one mesh; centroids are computed when the first selection needs them.
class Counter {
 public:
  explicit Counter(const Mesh& mesh)
      : mesh_(mesh), thickness_(border_thickness(mesh.points)), near_(10.0 * thickness_) {}

  void held(const std::string& path, const HeldSelection& held) {
    vertices(path, held.vertices);
    counts.back().along = name(held.axes);
  }
  void vertices(const std::string& path, const VertexSelection& selection) {
    if (std::holds_alternative<IdSelection>(selection))
      add(path, "vertices", select_points(selection, mesh_.points, path).size(), mesh_.points.size());
    else
      places(path, "vertices", selection, mesh_.points);
  }
  void cells(const std::string& path, const CellSelection& selection) {
    const std::size_t all = mesh_.cell_count();
    if (const auto* random = std::get_if<RandomSelection>(&selection)) {
      add(path, "cells", std::min<std::size_t>(random->count, all), all);
    } else if (const auto* by_id = std::get_if<IdSelection>(&selection)) {
      add(path, "cells", std::set(by_id->ids.begin(), by_id->ids.end()).size(), all);
    } else {
      if (centroids_.empty()) centroids_ = centroids(mesh_);
      places(path, "cells", selection, centroids_);
    }
  }
  std::vector<SelectionCount> counts;

 private:
  void add(const std::string& path, std::string_view of_what, std::size_t selected, std::size_t all,
           std::size_t just_outside = 0) {
    counts.push_back({path, of_what, selected, all, just_outside, near_});
  }
  template <class Selection>
  void places(const std::string& path, std::string_view of_what, const Selection& selection,
              std::span<const Eigen::Vector3d> at) {
    std::size_t selected = 0, reached = 0;
    std::visit(
        [&](const auto& region) {
          if constexpr (requires { contains(region, at[0], thickness_); })
            for (const Eigen::Vector3d& x : at) {
              const bool within = contains(region, x, thickness_);
              selected += within;
              reached += within || contains(region, x, near_);
            }
        },
        selection);
    add(path, of_what, selected, at.size(), reached - selected);
  }

  const Mesh& mesh_;
  double thickness_, near_;
  std::vector<Eigen::Vector3d> centroids_;
};

}  // namespace

std::string to_string(const SelectionCount& count) {
  const bool some_axes = !count.along.empty() && count.along != name(all_axes);
  return fmt::format("{}: {} of {} {}{}{}{}", count.path, count.selected, count.all, count.of_what,
                     some_axes ? ", along " : "", some_axes ? count.along : "",
                     !count.moves          ? ""
                     : count.selected == 0 ? " at the start; it acts where the body is then"
                                           : " at the start");
}

std::vector<SelectionCount> count_selections(const SceneFile& scene, const Mesh& mesh) {
  Counter counter(mesh);
  for (std::size_t k = 0; k < scene.fixed.size(); ++k) counter.held(fmt::format("/fixed/{}", k), scene.fixed[k]);
  for (const SceneDrive& drive : scene.driven) counter.vertices(drive.path, drive.vertices);
  for (const SceneForce& force : scene.forces) counter.vertices(force.path, force.vertices);
  for_each_selection_of_forces(scene, [&counter](const std::string& path, const VertexSelection& vertices) {
    counter.vertices(path, vertices);
  });
  for (const SceneRegion& region : scene.regions) counter.cells(region.path + "/cells", region.cells);
  const Overloads count_choice{
      [&counter](const std::string& path, const CellSelection& cells) { counter.cells(path, cells); },
      [&counter](const std::string& path, const VertexSelection& vertices) { counter.vertices(path, vertices); },
      [](const std::string&, const auto&) {}};  // numbers select what they name
  for (const SceneEvent& event : scene.events) for_each_choice(event, count_choice);
  return counter.counts;
}

std::string near_miss(const SelectionCount& count) {
  if (count.just_outside == 0) return "";
  return fmt::format("{}: {} {} just outside, less than {:.2g} m from the border, and not selected", count.path,
                     count.just_outside, count.just_outside == 1 ? "lies" : "lie", count.near);
}

}  // namespace dartboard
