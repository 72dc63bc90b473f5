#include "core/scene/timeline/applied_forces.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/bytes.h"
#include "core/plain/error.h"
#include "core/scene/forces/faces_under_pressure.h"
#include "core/scene/timeline/table_times.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
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

AppliedForces::AppliedForces(const SceneFile& scene, const Mesh& mesh, const VertexColumns& vertices)
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
    force.time.from = from.from;
    force.time.until = from.until.value_or(force.time.until);
    force.factor = from.factor;
    if (std::ranges::all_of(force.points, [&fixed](std::uint32_t p) { return fixed[p]; }))
      throw InputError(fmt::format(
          "{}: selects fixed or driven vertices alone, which no force moves; expected one that is free", from.path));
    if (from.shared_by != SharedBy::vertices) {
      const std::vector<double> size = loaded_sizes(from, mesh);
      const Vector3d over_size =
          from.traction ? *from.traction : Vector3d(*from.force / std::accumulate(size.begin(), size.end(), 0.0));
      for (const std::uint32_t p : force.points) force.pull.push_back(size[p] / mass[p] * over_size);
    } else if (from.force) {
      double sum = 0.0;
      for (const std::uint32_t p : force.points) sum += mass[p];
      force.pull = {*from.force / sum};
    } else if (from.acceleration) {
      force.pull = {*from.acceleration};
    } else if (from.torque) {
      force.pull = turning(from, force.points, mesh.points, mass);
    } else {
      std::vector<Vector3d> on(points_, Vector3d(0, 0, 0));  // [N]
      for (const PressedFace& face : faces_under_pressure(from, static_cast<std::uint32_t>(forces_.size()), mesh)) {
        std::array<Vector3d, 4> x;
        for (std::uint32_t k = 0; k < face.count; ++k) x[k] = mesh.points[face.corner[k]];
        const auto force_at = forces_of_pressure(*from.pressure, face.count, x);
        for (std::uint32_t k = 0; k < face.count; ++k) on[face.corner[k]] += force_at[k];
      }
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
    if (from.follows) {
      force.followed = *from.pressure;
      force.points = {};
      force.pull = {};
    }
    forces_.push_back(std::move(force));
  }
}

/// The mean of the factor over a time, zero where the force does not act.
double AppliedForces::Force::mean_factor(double begin, double end) const {
  const auto part = time.part_of(begin, end);
  if (!part) return 0.0;
  return (part->end - part->begin) / (end - begin) * (factor.empty() ? 1.0 : factor.mean(part->begin, part->end));
}

LoadChange AppliedForces::apply(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                                std::span<Vector3d> pull, std::span<double> pressure) {
  auto change = LoadChange::none;
  for (Force& force : forces_) {
    const double share = force.time.mean_sign(begin, end), factor = force.mean_factor(begin, end);
    if (share != std::exchange(force.share, share)) change = LoadChange::begins_or_ends;
    if (factor != std::exchange(force.now, factor)) change = std::max(change, LoadChange::in_value);
  }
  if (change != LoadChange::none) set_values(point_of_vertex, pull, pressure);
  return change;
}

std::optional<double> AppliedForces::next_between(double begin, double end) const {
  std::optional<double> next = first_between(forces_, begin, end);
  for (const Force& force : forces_)
    if (const auto at = first_between(force.factor.at, begin, next.value_or(end))) next = at;
  return next;
}

bool AppliedForces::follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                           std::span<Vector3d> pull, std::span<double> pressure) {
  bool changed = false;
  for (Force& force : forces_)
    if (force.share != 0.0 && !force.factor.empty()) {
      const double factor = force.factor.mean(begin, end);
      changed |= factor != std::exchange(force.now, factor);
    }
  if (changed) set_values(point_of_vertex, pull, pressure);
  return changed;
}

void AppliedForces::set_values(std::span<const std::uint32_t> point_of_vertex, std::span<Vector3d> pull,
                               std::span<double> pressure) const {
  std::vector<Vector3d> of_point(points_, Vector3d(0, 0, 0));
  for (const Force& force : forces_) {
    if (force.now == 0.0) continue;
    for (std::size_t k = 0; k < force.points.size(); ++k)
      of_point[force.points[k]] += force.now * (force.pull.size() == 1 ? force.pull[0] : force.pull[k]);
  }
  for (std::size_t k = 0; k < pull.size(); ++k)
    pull[k] = point_of_vertex[k] < points_ ? of_point[point_of_vertex[k]] : Vector3d(0, 0, 0);
  for (std::size_t f = 0; f < pressure.size(); ++f) pressure[f] = forces_[f].now * forces_[f].followed;
}

bool AppliedForces::sum_work() const {
  return std::ranges::any_of(forces_, [](const Force& force) {
    return !force.factor.empty() || force.followed != 0.0 || force.time.from > 0.0 || std::isfinite(force.time.until);
  });
}

std::size_t AppliedForces::bytes() const {
  std::size_t sum = 0;
  for (const Force& force : forces_) sum += bytes_of(force.points, force.pull, force.factor.at, force.factor.value);
  return sum;
}

}  // namespace dartboard
