#pragma once
// The external forces that a scene applies: on which vertices, and when.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mechanics/vertex_columns.h"
#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/timeline/acting_time.h"
#include "core/scene/timeline/load_change.h"

namespace dartboard {

/// Applies, changes and ends forces. In a step each is constant: its mean over the step, also where it begins or ends
/// within.
///
/// A force keeps its direction in a step, so it has a potential there. It is stored as an acceleration of each vertex,
/// whose parts share it in proportion to their masses: no cut changes the sum. A vertex that loses cells loses their
/// share. Pressures that follow their faces are a term of the body, whose values are set here.
class AppliedForces {
 public:
  AppliedForces() = default;
  /// `mesh` is the body at rest; its vertices are as they were built.
  ///
  /// throws  InputError "/forces/0...: ..." for a force on no vertex, or on fixed ones alone, a pressure where no facet
  ///         of the boundary is selected or there are no facets, and a torque about a line that all of its vertices are
  ///         on
  AppliedForces(const SceneFile& scene, const Mesh& mesh, const VertexColumns& vertices);

  /// Set the forces to their means over a step, from one time to another [s]: accelerations, and of pressures that
  /// follow their faces the values by number of force.
  ///
  /// cost     O(forces), and O(vertices + points pulled at) where one begins, changes or ends
  LoadChange apply(double begin, double end, std::span<const std::uint32_t> point_of_vertex,
                   std::span<Eigen::Vector3d> pull, std::span<double> pressure = {});

  /// Sets the pulls of those that act already and go on, in a time in which none begins or ends.
  ///
  /// returns  whether any has changed
  bool follow(double begin, double end, std::span<const std::uint32_t> point_of_vertex, std::span<Eigen::Vector3d> pull,
              std::span<double> pressure);

  /// [s] The first time between these two at which one begins or ends.
  std::optional<double> next_between(double begin, double end) const;

  std::size_t size() const { return forces_.size(); }
  /// Is their work summed, since they have no potential that lasts?
  bool sum_work() const;
  std::size_t bytes() const;
  /// Writes or reads the present factors; the forces themselves are in the scene.
  template <class Archive>
  void state(Archive& archive) {
    for (Force& force : forces_) archive(force.share, force.now);
  }

 private:
  struct Force {
    std::vector<std::uint32_t> points;  // of the mesh
    std::vector<Eigen::Vector3d> pull;  // [m/s^2] of each point, or one for all
    ActingTime time;
    TimeTable<double> factor;
    double followed = 0.0;  // [Pa] of a pressure that follows its faces; it has no points and no pull
    double share = 0.0;     // of this step, in which it acts
    double now = 0.0;       // the factor in this step

    double mean_factor(double begin, double end) const;
  };
  void set_values(std::span<const std::uint32_t> point_of_vertex, std::span<Eigen::Vector3d> pull,
                  std::span<double> pressure) const;

  std::vector<Force> forces_;
  std::size_t points_ = 0;  // of the mesh
};

}  // namespace dartboard
