#include "core/scene/timeline/applied_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <limits>
#include <map>

#include "core/base/bytes.h"
#include "core/plain/error.h"
#include "core/scene/file/step_times.h"
#include "core/scene/timeline/event_clock.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Corners = boost::container::static_vector<std::uint32_t, 4>;

/// Half the sum of the cross products of its corners, seen from the first.
Vector3d area_vector(const Corners& corners, std::span<const Vector3d> points) {
  Vector3d twice(0, 0, 0);
  const Vector3d& origin = points[corners[0]];
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    twice += (points[corners[k]] - origin).cross(points[corners[k + 1]] - origin);
  return twice / 2;
}

/// The faces that a pressure acts on: the boundary faces of solid cells, turned outwards; all faces of a surface, as
/// given. visit(corners, area vector [m^2])
template <class Visit>
void for_each_pressed_face(const Mesh& mesh, Visit&& visit) {
  struct Side {
    Corners corners;
    std::uint32_t cell;
    int cells;
  };
  std::map<Corners, Side> sides;  // by their corners in ascending order
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      Corners corners;
      for (const int k : cycle) corners.push_back(mesh.nodes[mesh.first[c] + static_cast<std::size_t>(k)]);
      if (mesh.dimension() == 2) {
        visit(corners, area_vector(corners, mesh.points));
        continue;
      }
      Corners key = corners;
      std::ranges::sort(key);
      ++sides.try_emplace(key, Side{corners, c, 0}).first->second.cells;
    }
  for (const auto& [key, side] : sides)
    if (side.cells == 1) {
      // counter-clockwise seen from outside a cell that is right-handed
      const double turn = signed_measure(mesh, side.cell) < 0.0 ? -1.0 : 1.0;
      visit(side.corners, turn * area_vector(side.corners, mesh.points));
    }
}

}  // namespace

AppliedForces::AppliedForces(const SceneFile& scene, const Mesh& mesh, const VertexColumns& vertices, double step)
    : points_(mesh.points.size()) {
  std::vector<double> mass(points_, 0.0);
  std::vector<bool> fixed(points_, false);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    mass[vertices.point[k]] = vertices.mass[k];
    fixed[vertices.point[k]] = !vertices.fixed.empty() && vertices.fixed[k] != 0;
  }
  for (const SceneForce& from : scene.forces) {
    Force force;
    force.points = select_points(from.vertices, mesh.points, from.path);
    require_some(force.points, from.path, mesh.points);
    force.first = step_of_time(from.from, step);
    force.last = from.until ? step_of_time(*from.until, step) : EventClock::never;
    if (std::ranges::all_of(force.points, [&fixed](std::uint32_t p) { return fixed[p]; }))
      throw InputError(fmt::format(
          "{}: selects fixed or driven vertices alone, which no force moves; expected one that is free", from.path));
    if (from.force) {
      double sum = 0.0;
      for (const std::uint32_t p : force.points) sum += mass[p];
      force.pull = {*from.force / sum};
    } else {
      std::vector<Vector3d> on(points_, Vector3d(0, 0, 0));  // [N]
      std::vector<bool> selected(points_, false);
      for (const std::uint32_t p : force.points) selected[p] = true;
      bool any = false;
      for_each_pressed_face(mesh, [&](const Corners& corners, const Vector3d& area) {
        if (!std::ranges::all_of(corners, [&selected](std::uint32_t p) { return selected[p]; })) return;
        any = true;
        for (const std::uint32_t p : corners) on[p] -= *from.pressure / static_cast<double>(corners.size()) * area;
      });
      if (!any)
        throw InputError(fmt::format("{}/pressure: all corners of no face {} are selected; expected one at least",
                                     from.path, mesh.dimension() == 3 ? "of the boundary" : "of a surface"));
      for (const std::uint32_t p : force.points) force.pull.push_back(on[p] / mass[p]);
    }
    for (const Vector3d& pull : force.pull)
      if (!(pull.squaredNorm() < std::numeric_limits<double>::max()))
        throw InputError(
            fmt::format("{}/{}: accelerates a vertex by {:.3g} m/s^2, whose square is not finite; expected a "
                        "smaller value",
                        from.path, from.force ? "force" : "pressure", pull.lpNorm<Eigen::Infinity>()));
    forces_.push_back(std::move(force));
  }
}

bool AppliedForces::apply(std::uint64_t n, std::span<const std::uint32_t> point_of_vertex, std::span<Vector3d> pull) {
  bool changed = false;
  for (Force& force : forces_) {
    const bool acts = n >= force.first && n < force.last;
    changed |= acts != force.acts;
    force.acts = acts;
  }
  if (!changed) return false;
  std::vector<Vector3d> of_point(points_, Vector3d(0, 0, 0));
  for (const Force& force : forces_) {
    if (!force.acts) continue;
    for (std::size_t k = 0; k < force.points.size(); ++k)
      of_point[force.points[k]] += force.pull.size() == 1 ? force.pull[0] : force.pull[k];
  }
  for (std::size_t k = 0; k < pull.size(); ++k)
    pull[k] = point_of_vertex[k] < points_ ? of_point[point_of_vertex[k]] : Vector3d(0, 0, 0);
  return true;
}

std::size_t AppliedForces::bytes() const {
  std::size_t sum = 0;
  for (const Force& force : forces_) sum += bytes_of(force.points, force.pull);
  return sum;
}

}  // namespace dartboard
