#pragma once
// The scenes of the tables before their events are frozen, and what happens in several of them.

#include <string>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// A scene made by a program. In contrast to a file, it starts from any positions.
struct TableScene {
  std::string name;
  Problem problem;                                  // at rest in its mesh; `h` is not used
  std::vector<Eigen::Vector3d> initial_position{};  // [m] by mesh point; empty for rest
  std::vector<SceneEvent> events{};
  double duration = 1.0;        // [s]
  std::size_t checkpoints = 8;  // at equal distances, the last at the end
};

/// At a time [s], dissociate the faces between the cells on different sides of a plane in the body at rest.
///
/// pre  a mesh of tetrahedra
void add_cut(TableScene& scene, double time, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

/// Make the tenth of the cells that are nearest to a place of another material, stiffer and more damped by a factor.
/// They start at rest: stretched like the others, they would hold almost all of the energy.
///
/// pre  the scene has initial positions and velocities
void add_inclusion(TableScene& scene, const Eigen::Vector3d& place, double factor);

/// The damping of each material [kg/s]: `time` [s] times its stiffness.
void set_damping(Problem& problem, double time);

}  // namespace dartboard
