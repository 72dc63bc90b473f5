#include "core/scene/timeline/driven_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/bytes.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/timeline/table_times.h"

namespace dartboard {

DrivenVertices::DrivenVertices(const SceneFile& scene, std::span<const Eigen::Vector3d> rest) {
  for (const SceneDrive& from : scene.driven) {
    Drive drive;
    drive.points = select_points(from.vertices, rest, from.path);
    require_some(drive.points, from.path, rest);
    if (from.has_table()) drive.table = from;
    for (const std::uint32_t p : drive.points)
      from.has_table() ? drive.rest.push_back(rest[p]) : drive.velocity.push_back(from.velocity.at(rest[p]));
    drive.time = {from.from, from.until.value_or(drive.time.until), from.reverse_every};
    drives_.push_back(std::move(drive));
  }
  if (drives_.empty()) return;
  require_apart(scene, rest);
  place_.assign(rest.size(), none);
  for (const Drive& drive : drives_)
    for (const std::uint32_t p : drive.points)
      if (place_[p] == none) {
        place_[p] = static_cast<std::uint32_t>(now_.size());
        now_.emplace_back(0, 0, 0);
      }
  next_ = now_;
}

void DrivenVertices::require_apart(const SceneFile& scene, std::span<const Eigen::Vector3d> rest) const {
  const std::vector<HeldAxes> held = held_axes_of(scene.fixed, rest);
  std::vector<std::vector<std::size_t>> met(rest.size());  // the drives of each point
  for (std::size_t d = 0; d < drives_.size(); ++d)
    for (const std::uint32_t p : drives_[d].points) {
      if (held[p] != 0)
        throw InputError(fmt::format("{}: drives point {}, and /fixed holds it{}; expected one of them",
                                     scene.driven[d].path, number_in_file(scene, p),
                                     held[p] == all_axes ? " still" : ""));
      for (const std::size_t other : met[p])
        if (drives_[d].time.overlaps(drives_[other].time))
          throw InputError(fmt::format(
              "{}: drives point {} from {:.6g} to {:.6g} s, and {} from {:.6g} to {:.6g} s; expected one at a time",
              scene.driven[d].path, number_in_file(scene, p), scene.driven[d].from,
              scene.driven[d].until.value_or(scene.duration), scene.driven[other].path, scene.driven[other].from,
              scene.driven[other].until.value_or(scene.duration)));
      met[p].push_back(d);
    }
}

/// The sums of what drives do: one may end in the step in which another begins. Returns whether a velocity has changed.
bool DrivenVertices::set_means(double begin, double end) {
  next_.assign(now_.size(), Eigen::Vector3d(0, 0, 0));
  for (const Drive& drive : drives_) {
    if (drive.sign == 0.0) continue;
    for (std::size_t k = 0; k < drive.points.size(); ++k)
      next_[place_[drive.points[k]]] +=
          drive.table ? drive.table->velocity_of(drive.rest[k], begin, end) : drive.sign * drive.velocity[k];
  }
  now_.swap(next_);
  return now_ != next_;
}

LoadChange DrivenVertices::apply(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                                 std::span<Eigen::Vector3d> velocity) {
  bool turns = false, follows = false;
  for (Drive& drive : drives_) {
    double sign = drive.time.mean_sign(begin, end);
    if (drive.table && sign != 0.0) {
      sign = 1.0;
      follows = true;
    }
    if (sign != std::exchange(drive.sign, sign)) turns = true;
  }
  if (!turns && !follows) return LoadChange::none;
  const bool moved = set_means(begin, end);
  if (turns || moved) set_velocities(point_of_vertex, velocity);
  return turns ? LoadChange::begins_or_ends : moved ? LoadChange::in_value : LoadChange::none;
}

std::optional<double> DrivenVertices::next_between(double begin, double end) const {
  std::optional<double> next = first_between(drives_, begin, end);
  for (const Drive& drive : drives_)
    if (drive.table)
      if (const auto at = first_between(times_of(*drive.table), begin, next.value_or(end))) next = at;
  return next;
}

bool DrivenVertices::follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                            std::span<Eigen::Vector3d> velocity) {
  const auto is_followed = [](const Drive& drive) { return drive.table && drive.sign != 0.0; };
  if (!std::ranges::any_of(drives_, is_followed) || !set_means(begin, end)) return false;
  set_velocities(point_of_vertex, velocity);
  return true;
}

void DrivenVertices::set_velocities(std::span<const std::uint32_t> point_of_vertex,
                                    std::span<Eigen::Vector3d> velocity) const {
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const std::uint32_t p = point_of_vertex[k];
    if (moves(p)) velocity[k] = now_[place_[p]];
  }
}

std::size_t DrivenVertices::bytes() const {
  std::size_t sum = bytes_of(place_, now_, next_);
  for (const Drive& drive : drives_) sum += bytes_of(drive.points, drive.velocity, drive.rest);
  return sum;
}

}  // namespace dartboard
