#include "core/scene/timeline/applied_forces.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
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

/// The accelerations alpha x (X - centre of mass) of vertices whose forces have this moment [N m].
std::vector<Vector3d> turning(const SceneForce& force, std::span<const std::uint32_t> points,
                              std::span<const Vector3d> place, std::span<const double> mass) {
  double sum = 0.0;
  Vector3d centre(0, 0, 0);
  for (const std::uint32_t p : points) {
    centre += mass[p] * place[p];
    sum += mass[p];
  }
  centre /= sum;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const std::uint32_t p : points) {
    const Vector3d r = place[p] - centre;
    inertia += mass[p] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
  const double largest = axes.eigenvalues()[2];
  Vector3d alpha(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.eigenvectors().col(k);
    const double about_it = axis.dot(*force.torque);
    if (axes.eigenvalues()[k] > 1e-12 * largest)
      alpha += about_it / axes.eigenvalues()[k] * axis;
    else if (std::abs(about_it) > 1e-9 * force.torque->norm())
      throw InputError(fmt::format(
          "{}/torque: acts on {}, and forces there have no moment about {}; expected vertices that are not on one line",
          force.path, points.size() == 1 ? "one vertex" : "vertices that are on one line at rest",
          points.size() == 1 ? "it" : "that line"));
  }
  std::vector<Vector3d> pull;
  for (const std::uint32_t p : points) pull.emplace_back(alpha.cross(place[p] - centre));
  return pull;
}

}  // namespace

AppliedForces::AppliedForces(const SceneFile& scene, const Mesh& mesh, const VertexColumns& vertices, double step)
    : points_(mesh.points.size()), step_(step) {
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
    force.factor = from.factor;
    if (std::ranges::all_of(force.points, [&fixed](std::uint32_t p) { return fixed[p]; }))
      throw InputError(fmt::format(
          "{}: selects fixed or driven vertices alone, which no force moves; expected one that is free", from.path));
    if (from.force) {
      double sum = 0.0;
      for (const std::uint32_t p : force.points) sum += mass[p];
      force.pull = {*from.force / sum};
    } else if (from.acceleration) {
      force.pull = {*from.acceleration};
    } else if (from.torque) {
      force.pull = turning(from, force.points, mesh.points, mass);
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
    double most = 1.0;
    for (const double factor : force.factor.value) most = std::max(most, std::abs(factor));
    for (const Vector3d& pull : force.pull)
      if (!((most * pull).squaredNorm() < std::numeric_limits<double>::max()))
        throw InputError(
            fmt::format("{}/{}: accelerates a vertex by {:.3g} m/s^2, whose square is not finite; expected a "
                        "smaller value",
                        from.path, from.kind(), most * pull.lpNorm<Eigen::Infinity>()));
    forces_.push_back(std::move(force));
  }
}

LoadChange AppliedForces::apply(std::uint64_t n, std::span<const std::uint32_t> point_of_vertex,
                                std::span<Vector3d> pull) {
  auto change = LoadChange::none;
  for (Force& force : forces_) {
    const bool acts = n >= force.first && n < force.last;
    const double factor = force.factor.empty()
                              ? 1.0
                              : force.factor.mean(static_cast<double>(n) * step_, static_cast<double>(n + 1) * step_);
    if (acts != force.acts) change = LoadChange::begins_or_ends;
    if (acts && factor != force.now) change = std::max(change, LoadChange::in_value);
    force.acts = acts;
    force.now = factor;
  }
  if (change == LoadChange::none) return change;
  std::vector<Vector3d> of_point(points_, Vector3d(0, 0, 0));
  for (const Force& force : forces_) {
    if (!force.acts) continue;
    for (std::size_t k = 0; k < force.points.size(); ++k)
      of_point[force.points[k]] += force.now * (force.pull.size() == 1 ? force.pull[0] : force.pull[k]);
  }
  for (std::size_t k = 0; k < pull.size(); ++k)
    pull[k] = point_of_vertex[k] < points_ ? of_point[point_of_vertex[k]] : Vector3d(0, 0, 0);
  return change;
}

bool AppliedForces::change_in_time() const {
  return std::ranges::any_of(forces_, [](const Force& force) { return !force.factor.empty(); });
}

std::size_t AppliedForces::bytes() const {
  std::size_t sum = 0;
  for (const Force& force : forces_) sum += bytes_of(force.points, force.pull, force.factor.at, force.factor.value);
  return sum;
}

}  // namespace dartboard
