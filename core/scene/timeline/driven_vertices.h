#pragma once
// The vertices that a scene moves along given paths: their velocities, and when they apply.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mechanics/vertex_columns.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/timeline/acting_time.h"
#include "core/scene/timeline/load_change.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// Gives driven vertices their velocities, in each step the mean over it, so that at its end they are where they should
/// be. Integrators keep the velocity of a fixed vertex, which moves along straight lines, whatever acts on it.
///
/// Vertices are known by the mesh point they came from. Their numbers may change, and all parts of one that came apart
/// are driven.
class DrivenVertices {
 public:
  DrivenVertices() = default;
  /// throws  InputError "/driven/0...: ..." for a drive of no vertex, of a fixed one, or of one that another drive
  ///         moves at that time
  DrivenVertices(const SceneFile& scene, std::span<const Eigen::Vector3d> rest);

  /// Set the velocities to their means over a step, from one time to another [s].
  ///
  /// cost     O(drives), and O(vertices) where one starts, turns back or ends, and in every step of a path or a turn
  LoadChange apply(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                   std::span<Eigen::Vector3d> velocity);

  /// Sets the velocities of paths and turns alone, in a time in which nothing starts, turns back or ends.
  ///
  /// returns  whether any has changed
  bool follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
              std::span<Eigen::Vector3d> velocity);

  /// [s] The first time between these two at which one begins, turns back or ends.
  std::optional<double> next_between(double begin, double end) const;

  /// Is this a point of the mesh that some drive moves?
  bool moves(std::uint32_t point) const { return point < place_.size() && place_[point] != none; }
  /// Vertices of the mesh that some drive moves.
  std::size_t size() const { return now_.size(); }
  std::size_t bytes() const;
  /// Writes or reads the present velocities; the drives themselves are in the scene.
  template <class Archive>
  void state(Archive& archive) {
    for (Drive& drive : drives_) archive(drive.sign);
    archive(now_);
  }

 private:
  struct Drive {
    std::vector<std::uint32_t> points;  // of the mesh
    std::vector<Eigen::Vector3d> velocity;
    std::optional<SceneDrive> table;  // of a path or a turn, with the places of its points at rest; no velocities then
    std::vector<Eigen::Vector3d> rest;
    ActingTime time;
    double sign = 0.0;  // mean over this step, of the velocity; 0 at rest, and 1 on all of a path or a turn
  };
  bool set_means(double begin, double end);
  void set_velocities(std::span<const std::uint32_t> point_of_vertex, std::span<Eigen::Vector3d> velocity) const;
  void require_apart(const SceneFile& scene, std::span<const Eigen::Vector3d> rest) const;

  std::vector<Drive> drives_;
  std::vector<std::uint32_t> place_;   // by mesh point: in now_, or `none`
  std::vector<Eigen::Vector3d> now_;   // [m/s] of each driven point
  std::vector<Eigen::Vector3d> next_;  // scratch
  static constexpr std::uint32_t none = no_point;
};

}  // namespace dartboard
