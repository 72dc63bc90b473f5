#include "core/scene/file/selection.h"

#include <fmt/format.h>

#include <string>

#include "core/plain/error.h"

namespace dartboard {

bool contains(const BoxSelection& box, const Eigen::Vector3d& x) {
  return (x.array() >= box.min.array()).all() && (x.array() <= box.max.array()).all();
}

bool contains(const PlaneSelection& plane, const Eigen::Vector3d& x) {
  return (x - plane.point).dot(plane.normal) >= 0.0;
}

bool contains(const SphereSelection& sphere, const Eigen::Vector3d& x) {
  return (x - sphere.centre).norm() <= sphere.radius;
}

namespace {

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
  for (std::size_t p = 0; p < points.size(); ++p) {
    const bool inside = std::visit(
        [&](const auto& region) {
          if constexpr (requires { contains(region, points[p]); })
            return contains(region, points[p]);
          else
            return false;
        },
        selection);
    if (inside) chosen[p] = true;
  }
}

std::vector<std::uint32_t> numbers_of(const std::vector<bool>& chosen) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t p = 0; p < chosen.size(); ++p)
    if (chosen[p]) numbers.push_back(p);
  return numbers;
}

}  // namespace

void require_some(std::span<const std::uint32_t> points, std::string_view path) {
  if (points.empty()) throw InputError(fmt::format("{}: selects no vertex; expected at least one", path));
}

std::vector<std::uint32_t> select_points(const VertexSelection& selection, std::span<const Eigen::Vector3d> points,
                                         std::string_view path) {
  std::vector<bool> chosen(points.size(), false);
  choose(selection, points, path, chosen);
  return numbers_of(chosen);
}

std::vector<std::uint32_t> select_points(std::span<const VertexSelection> selections,
                                         std::span<const Eigen::Vector3d> points, std::string_view path) {
  std::vector<bool> chosen(points.size(), false);
  for (std::size_t s = 0; s < selections.size(); ++s) {
    const std::string at = fmt::format("{}/{}", path, s);
    const auto selected = select_points(selections[s], points, at);
    require_some(selected, at);
    for (const std::uint32_t p : selected) chosen[p] = true;
  }
  return numbers_of(chosen);
}

}  // namespace dartboard
