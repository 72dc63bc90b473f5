#pragma once
// The vertices that a scene moves along given paths: their velocities, and when they apply.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mechanics/vertex_columns.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/timeline/event_clock.h"
#include "core/scene/timeline/load_change.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Gives driven vertices their velocities at step boundaries. Integrators keep the velocity of a fixed vertex, so it
/// moves along straight lines in between, whatever acts on it: from one place to the next where it follows a path or a
/// turn.
///
/// Vertices are known by the mesh point they came from. Their numbers may change, and all parts of one that came apart
/// are driven.
class DrivenVertices {
 public:
  DrivenVertices() = default;
  /// throws  InputError "/driven/0...: ..." for a drive of no vertex, of a fixed one, or of one that another drive
  ///         moves at that time
  DrivenVertices(const SceneFile& scene, std::span<const Eigen::Vector3d> rest, double step);

  /// Set the velocities that are due after n steps.
  ///
  /// pre      called for 0, then for ascending n, whenever something is due
  /// cost     O(drives), and O(vertices) where one starts, turns back or ends, and in every step of a path or a turn
  LoadChange apply(std::uint64_t n, std::span<const std::uint32_t> point_of_vertex,
                   std::span<Eigen::Vector3d> velocity);

  /// Set the velocities of those that are on a path or a turn to their means from one time to another [s], whatever the
  /// step.
  ///
  /// returns  whether any has changed
  bool follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
              std::span<Eigen::Vector3d> velocity);

  /// Is this a point of the mesh that some drive moves?
  bool moves(std::uint32_t point) const { return point < place_.size() && place_[point] != none; }
  /// Vertices of the mesh that some drive moves.
  std::size_t size() const { return now_.size(); }
  std::size_t bytes() const;
  /// As EventClock::extend.
  void extend() {
    for (Drive& drive : drives_)
      if (drive.turn) drive.turn->extend();
  }
  /// Writes or reads the progress of the drives; their vertices and velocities are in the scene.
  template <class Archive>
  void state(Archive& archive) {
    for (Drive& drive : drives_) {
      archive(drive.sign);
      if (drive.turn) archive(*drive.turn);
    }
    archive(now_);
  }

 private:
  struct Drive {
    std::vector<std::uint32_t> points;  // of the mesh
    std::vector<Eigen::Vector3d> velocity;
    std::optional<SceneDrive> table;  // of a path or a turn, with the places of its points at rest; no velocities then
    std::vector<Eigen::Vector3d> rest;
    std::uint64_t first, last;       // steps that it starts and ends after
    std::optional<EventClock> turn;  // the boundaries where it is reversed
    double sign = 0.0;               // of the present velocity; 0 at rest
  };
  bool follow(const Drive& drive, double begin, double end);
  void set_velocities(std::span<const std::uint32_t> point_of_vertex, std::span<Eigen::Vector3d> velocity) const;
  void require_apart(const SceneFile& scene, std::span<const Eigen::Vector3d> rest) const;

  double step_ = 0.0;  // [s]
  std::vector<Drive> drives_;
  std::vector<std::uint32_t> place_;  // by mesh point: in now_, or `none`
  std::vector<Eigen::Vector3d> now_;  // [m/s] of each driven point
  static constexpr std::uint32_t none = no_point;
};

}  // namespace dartboard
