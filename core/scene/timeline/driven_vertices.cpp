#include "core/scene/timeline/driven_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/bytes.h"
#include "core/plain/error.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/step_times.h"

namespace dartboard {

DrivenVertices::DrivenVertices(const SceneFile& scene, std::span<const Eigen::Vector3d> rest, double step)
    : step_(step) {
  for (const SceneDrive& from : scene.driven) {
    Drive drive;
    drive.points = select_points(from.vertices, rest, from.path);
    require_some(drive.points, from.path, rest);
    if (from.has_table()) drive.table = from;
    for (const std::uint32_t p : drive.points)
      from.has_table() ? drive.rest.push_back(rest[p]) : drive.velocity.push_back(from.velocity.at(rest[p]));
    // a path or a turn that begins within a step is followed from there
    drive.first = from.has_table() ? step_until(from.from, step) : step_of_time(from.from, step);
    drive.last = from.until ? step_of_time(*from.until, step) : EventClock::never;
    if (from.reverse_every) {
      drive.turn.emplace(from.from, from.until.value_or(scene.duration), from.reverse_every, step);
      drive.turn->advance();  // the first time is the start
    }
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
        if (drives_[d].first < drives_[other].last && drives_[other].first < drives_[d].last)
          throw InputError(fmt::format(
              "{}: drives point {} from {:.6g} to {:.6g} s, and {} from {:.6g} to {:.6g} s; expected one at a time",
              scene.driven[d].path, number_in_file(scene, p), scene.driven[d].from,
              scene.driven[d].until.value_or(scene.duration), scene.driven[other].path, scene.driven[other].from,
              scene.driven[other].until.value_or(scene.duration)));
      met[p].push_back(d);
    }
}

/// Along a path or a turn. Returns whether a velocity has changed.
bool DrivenVertices::follow(const Drive& drive, double begin, double end) {
  bool changed = false;
  for (std::size_t k = 0; k < drive.points.size(); ++k) {
    Eigen::Vector3d& v = now_[place_[drive.points[k]]];
    const Eigen::Vector3d next = drive.table->velocity_of(drive.rest[k], begin, end);
    changed = changed || next != v;
    v = next;
  }
  return changed;
}

bool DrivenVertices::follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                            std::span<Eigen::Vector3d> velocity) {
  bool changed = false;
  for (const Drive& drive : drives_)
    if (drive.table && drive.sign != 0.0 && follow(drive, begin, end)) changed = true;
  if (changed) set_velocities(point_of_vertex, velocity);
  return changed;
}

LoadChange DrivenVertices::apply(std::uint64_t n, std::span<const std::uint32_t> point_of_vertex,
                                 std::span<Eigen::Vector3d> velocity) {
  auto changed = LoadChange::none;
  const auto set = [this, &changed](Drive& drive, double sign) {
    if (sign == drive.sign) return;
    drive.sign = sign;
    changed = LoadChange::begins_or_ends;
    for (std::size_t k = 0; k < drive.points.size(); ++k) {
      Eigen::Vector3d& v = now_[place_[drive.points[k]]];
      v.setZero();
      if (sign != 0.0) v = sign * drive.velocity[k];
    }
  };
  // one drive may end where another begins
  for (Drive& drive : drives_)
    if (n >= drive.last) set(drive, 0.0);
  for (Drive& drive : drives_) {
    if (n < drive.first || n >= drive.last) continue;
    if (drive.table) {
      const bool moved = follow(drive, static_cast<double>(n) * step_, static_cast<double>(n + 1) * step_);
      const bool begins = std::exchange(drive.sign, 1.0) == 0.0;
      changed = std::max(changed, begins  ? LoadChange::begins_or_ends
                                  : moved ? LoadChange::in_value
                                          : LoadChange::none);
      continue;
    }
    double sign = drive.sign == 0.0 ? 1.0 : drive.sign;
    for (; drive.turn && drive.turn->next() <= n; drive.turn->advance()) sign = -sign;
    set(drive, sign);
  }
  if (changed != LoadChange::none) set_velocities(point_of_vertex, velocity);
  return changed;
}

void DrivenVertices::set_velocities(std::span<const std::uint32_t> point_of_vertex,
                                    std::span<Eigen::Vector3d> velocity) const {
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const std::uint32_t p = point_of_vertex[k];
    if (moves(p)) velocity[k] = now_[place_[p]];
  }
}

std::size_t DrivenVertices::bytes() const {
  std::size_t sum = bytes_of(place_, now_);
  for (const Drive& drive : drives_) sum += bytes_of(drive.points, drive.velocity, drive.rest);
  return sum;
}

}  // namespace dartboard
