#include "benchmarks/studies/step/scene_columns.h"

#include <fmt/format.h>

#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "core/plain/error.h"

namespace dartboard {

bool has_lanes() {
  use_lanes(true);
  return lanes_are_on();
}

unsigned count_processors() {
  const unsigned before = use_threads(0), all = use_threads(before);
  return all;
}

MannerBefore::MannerBefore() : lanes_(use_lanes(true)), threads_(threads_in_use()) { use_lanes(lanes_); }

MannerBefore::~MannerBefore() {
  use_lanes(lanes_);
  use_threads(threads_);
}

void SceneColumns::step(int n) {
  for (int k = 0; k < n; ++k) {
    VertexColumns& v = vertices_();
    if (const StepResult result = integrator_->step(system_(), {v.position, v.velocity}, h_); !result.ok())
      throw SolverError(fmt::format("a step of '{}' failed: {}", manner_.task, to_string(result)));
  }
}

PointState SceneColumns::state() const {
  const VertexColumns& v = vertices_();
  PointState state{std::vector<Eigen::Vector3d>(v.size()), std::vector<Eigen::Vector3d>(v.size())};
  for (std::size_t k = 0; k < v.size(); ++k) {
    state.x[v.point[k]] = v.position[k];
    state.v[v.point[k]] = v.velocity[k];
  }
  return state;
}

void SceneColumns::set_state(const PointState& state) {
  choose();
  VertexColumns& v = vertices_();
  for (std::size_t k = 0; k < v.size(); ++k) {
    v.position[k] = state.x[v.point[k]];
    v.velocity[k] = state.v[v.point[k]];
  }
}

std::vector<Eigen::Vector3d> SceneColumns::forces() {
  const VertexColumns& v = vertices_();
  return spring_and_drag_forces(system_(), v.position, v.velocity, v.point);
}

void SceneColumns::choose() const {
  use_lanes(manner_.lanes);
  use_threads(manner_.threads);
  if (manner_.threads > 1) thread_team().run([](unsigned) {});
}

}  // namespace dartboard
