#pragma once
// The spring system of a problem with a motion of its own, which plans analyse.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// A body that stays unchanged, and positions and velocities that may move without it.
class SystemArrays {
 public:
  /// With the needs of a scene, except for changes of topology.
  ///
  /// throws  InputError as make_simulated_body does
  SystemArrays(const Problem& problem, BodyNeeds needs) {
    needs.topology_changes = false;
    body_ = make_simulated_body(problem, needs);
    const Motion start = body_->motion();
    x.assign(start.x.begin(), start.x.end());
    v.assign(start.v.begin(), start.v.end());
  }

  const SimulatedBody& body() const { return *body_; }
  SpringSystem system() const { return body_->system(); }
  Motion motion() { return {x, v}; }

  std::vector<Eigen::Vector3d> x, v;

 private:
  std::unique_ptr<SimulatedBody> body_;
};

}  // namespace dartboard
