#pragma once
// The columns of a body that has changed, those of a fresh body in its place, and their comparison.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/forces/springs.h"
#include "core/mechanics/vertex_columns.h"
#include "core/plain/problem.h"
#include "core/scene/body/simulated_body.h"
#include "core/time/system/spring_system.h"
#include "validation/contenders/contender_body.h"

namespace dartboard {

/// Before bodies are compared or timed: they start with velocities, and springs are to have other lengths than at rest.
inline constexpr int steps_to_start = 2;

/// All that a step over springs reads and writes, apart from the body that it was taken from.
struct KeptColumns {
  VertexColumns at;
  Springs springs;
  std::vector<SpringEnds> ends;
  Eigen::Vector3d gravity{0, 0, 0};
  double h = 0.0;  // [s] the step

  VertexColumns& vertices() { return at; }
  SpringSystem system() const { return system_of(at, ends, springs, gravity, {}); }
  template <class Archive>
  void state(Archive& archive) {
    archive(at, springs, ends, gravity, h);
  }
};

/// throws  IoError
void write_columns(const std::filesystem::path& file, KeptColumns& columns);
KeptColumns read_columns(const std::filesystem::path& file);

/// The problem of cells and vertices as they are now: the points of its mesh are the vertices.
/// pre  they have not moved yet
Problem present_problem(Mesh mesh, const VertexColumns& vertices, const Problem& start);
/// The columns of a body, as they are; their points are those of `present_problem`.
KeptColumns kept_columns(const VertexColumns& vertices, const SpringSystem& system, double h);

/// A body made of the cells and vertices of a changed one.
struct FreshBody {
  std::shared_ptr<SimulatedBody> scene;  // as a scene makes it
  /// Its columns with the springs of the changed body. Where an edge has come apart between two vertices that have not,
  /// the scene's body has one spring in place of several parallel ones; here these follow each other.
  KeptColumns columns;

  /// throws  SolverError if a spring of one body lies between vertices that none of the other's does
  FreshBody(const Problem& present, const KeptColumns& changed);
};

/// How many bodies have other forces than the changed columns, in motion, by more than the rounding of their sums. All
/// have the points of these columns.
std::size_t count_differing(const KeptColumns& changed, std::span<ContenderBody* const> others);

}  // namespace dartboard
