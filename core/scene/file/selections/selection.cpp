#include "core/scene/file/selections/selection.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <string>

#include "core/places/border.h"
#include "core/plain/error.h"
#include "core/scene/file/keys/scene_value.h"

namespace dartboard {

IdSelection IdSelection::read(const SceneValue& value) { return {value.as<std::vector<std::uint32_t>>()}; }

TagSelection TagSelection::read(const SceneValue& value) {
  const auto of = value.get<std::string>("of");
  if (value.has("named")) return {of, value.get<std::string>("named")};
  return {of, value.get<std::int32_t>("value")};
}

RandomSelection RandomSelection::read(const SceneValue& value) {
  return {value.get<std::uint32_t>("count"), value.get<std::uint64_t>("seed")};
}

HeldSelection HeldSelection::read(const SceneValue& value) {
  HeldSelection held{read_vertices(value), 0};
  for (const auto& axis : value.get<std::vector<std::string>>("axes"))
    held.axes |= axis == "x" ? HeldAxes{1} : axis == "y" ? HeldAxes{2} : HeldAxes{4};
  return held;
}

VertexSelection read_vertices(const SceneValue& value) { return read_one_of<VertexSelection>(value).value(); }
CellSelection read_cells(const SceneValue& value) { return read_one_of<CellSelection>(value).value(); }

bool contains(const CutRegion& region, const Eigen::Vector3d& x, double thickness) {
  return std::visit([&](const auto& of_a_kind) { return contains(of_a_kind, x, thickness); }, region);
}

namespace {

/// Calls f(k) for each place in a region; does nothing if the selection is not a region.
template <class Selection, class F>
void for_each_inside(const Selection& selection, std::span<const Eigen::Vector3d> places, double thickness, F&& f) {
  std::visit(
      [&](const auto& region) {
        if constexpr (requires { contains(region, places[0], thickness); })
          for (std::uint32_t k = 0; k < places.size(); ++k)
            if (contains(region, places[k], thickness)) f(k);
      },
      selection);
}

void choose(const VertexSelection& selection, std::span<const Eigen::Vector3d> points, std::string_view path,
            std::vector<bool>& chosen) {
  if (const auto* by_id = std::get_if<IdSelection>(&selection)) {
    for (std::size_t k = 0; k < by_id->ids.size(); ++k) {
      if (by_id->ids[k] >= points.size())
        throw InputError(fmt::format("{}/ids/{}: is {}; expected a point of the mesh, less than {}", path, k,
                                     by_id->ids[k], points.size()));
      chosen[by_id->ids[k]] = true;
    }
    return;
  }
  for_each_inside(selection, points, border_thickness(points), [&chosen](std::uint32_t p) { chosen[p] = true; });
}

std::vector<std::uint32_t> numbers_of(const std::vector<bool>& chosen) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t p = 0; p < chosen.size(); ++p)
    if (chosen[p]) numbers.push_back(p);
  return numbers;
}

}  // namespace

void require_some(std::span<const std::uint32_t> selected, std::string_view path,
                  std::span<const Eigen::Vector3d> points) {
  if (!selected.empty()) return;
  if (points.empty()) throw InputError(fmt::format("{}: selects no vertex; expected at least one", path));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  const Eigen::Vector3d &low = box.min(), &high = box.max();
  throw InputError(
      fmt::format("{}: selects no vertex; expected at least one of the body, which is from [{:.4g}, {:.4g}, {:.4g}] to "
                  "[{:.4g}, {:.4g}, {:.4g}]",
                  path, low[0], low[1], low[2], high[0], high[1], high[2]));
}

std::vector<std::uint32_t> select_points(const VertexSelection& selection, std::span<const Eigen::Vector3d> points,
                                         std::string_view path) {
  std::vector<bool> chosen(points.size(), false);
  choose(selection, points, path, chosen);
  return numbers_of(chosen);
}

std::vector<std::uint32_t> cells_in(const CellSelection& selection, std::span<const Eigen::Vector3d> centroids,
                                    double thickness) {
  std::vector<std::uint32_t> cells;
  for_each_inside(selection, centroids, thickness, [&cells](std::uint32_t c) { cells.push_back(c); });
  return cells;
}

std::vector<HeldAxes> held_axes_of(std::span<const HeldSelection> selections, std::span<const Eigen::Vector3d> points,
                                   std::string_view path) {
  std::vector<HeldAxes> held(points.size(), 0);
  for (std::size_t s = 0; s < selections.size(); ++s) {
    const std::string at = fmt::format("{}/{}", path, s);
    const auto selected = select_points(selections[s].vertices, points, at);
    require_some(selected, at, points);
    for (const std::uint32_t p : selected) held[p] |= selections[s].axes;
  }
  return held;
}

}  // namespace dartboard
