#include "core/scene/file/selection.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/places/border.h"
#include "core/plain/error.h"

namespace dartboard {

bool contains(const BoxSelection& box, const Eigen::Vector3d& x, double thickness) {
  for (int k = 0; k < 3; ++k) {
    const auto is_beyond = [&](double distance, double border) {
      return !is_inside(distance, std::max(std::abs(x[k]), std::abs(border)), thickness);
    };
    if (is_beyond(x[k] - box.min[k], box.min[k]) || is_beyond(box.max[k] - x[k], box.max[k])) return false;
  }
  return true;
}

bool contains(const PlaneSelection& plane, const Eigen::Vector3d& x, double thickness) {
  return is_in_front(x, plane.point, plane.normal, thickness);
}

bool contains(const SphereSelection& sphere, const Eigen::Vector3d& x, double thickness) {
  const double size = std::max(x.lpNorm<Eigen::Infinity>(), sphere.centre.lpNorm<Eigen::Infinity>());
  return is_inside(sphere.radius - (x - sphere.centre).norm(), std::max(size, sphere.radius), thickness);
}

namespace {

/// The distance of a point from a straight line between two others.
double distance_to_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length_2 = along.squaredNorm();
  const double t = length_2 > 0.0 ? std::clamp((x - from).dot(along) / length_2, 0.0, 1.0) : 0.0;
  return (x - from - t * along).norm();
}

/// The distance of a point from the parallelogram at `corner` with these sides: from its inside if the foot of the
/// perpendicular is there, otherwise from one of its edges.
double distance_to_parallelogram(const Eigen::Vector3d& x, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                                 const Eigen::Vector3d& v) {
  double least = std::min(
      std::min(distance_to_segment(x, corner, corner + u), distance_to_segment(x, corner, corner + v)),
      std::min(distance_to_segment(x, corner + u, corner + u + v), distance_to_segment(x, corner + v, corner + u + v)));
  const Eigen::Vector3d normal = u.cross(v), at = x - corner;
  const double area_2 = normal.squaredNorm();
  if (area_2 > 0.0) {
    const double s = at.cross(v).dot(normal) / area_2, t = u.cross(at).dot(normal) / area_2;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) least = std::abs(at.dot(normal)) / std::sqrt(area_2);
  }
  return least;
}

}  // namespace

bool contains(const AroundSelection& around, const Eigen::Vector3d& x, double thickness) {
  const std::vector<Eigen::Vector3d>& path = around.sweep.path;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const double size =
        std::max({x.lpNorm<Eigen::Infinity>(), path[k].lpNorm<Eigen::Infinity>(), path[k + 1].lpNorm<Eigen::Infinity>(),
                  around.sweep.depth.lpNorm<Eigen::Infinity>(), around.distance});
    const double distance = distance_to_parallelogram(x, path[k], path[k + 1] - path[k], around.sweep.depth);
    if (is_inside(around.distance - distance, size, thickness)) return true;
  }
  return false;
}

bool contains(const PolygonSelection& polygon, const Eigen::Vector3d& x, double thickness) {
  const Eigen::Vector3d right = polygon.along.unitOrthogonal(), up = polygon.along.cross(right);
  const auto seen = [&](const Eigen::Vector3d& d) { return Eigen::Vector3d(d.dot(right), d.dot(up), 0.0); };
  bool inside = false;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Eigen::Vector3d a = polygon.corners[k] - x, b = polygon.corners[(k + 1) % polygon.corners.size()] - x;
    const double size =
        std::max({x.lpNorm<Eigen::Infinity>(), a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>()});
    if (is_inside(-distance_to_segment({0, 0, 0}, seen(a), seen(b)), size, thickness)) return true;  // on its border
    const double a_up = a.dot(up), b_up = b.dot(up);
    if ((a_up > 0.0) == (b_up > 0.0)) continue;
    if (a.dot(right) + a_up / (a_up - b_up) * (b - a).dot(right) > 0.0) inside = !inside;
  }
  return inside;
}

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
