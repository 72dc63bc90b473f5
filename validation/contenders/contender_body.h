#pragma once
// The common interface of all contenders, whatever carries their bodies.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

/// A body in motion, accessed in the order of the mesh's points.
class ContenderBody {
 public:
  virtual ~ContenderBody() = default;
  /// Advance by n steps of the problem's h with the classical Runge-Kutta method.
  virtual void step(int n) = 0;
  virtual PointState state() const = 0;
  virtual void set_state(const PointState& state) = 0;
  /// Springs and ambient drag on each point [N], in the present state.
  virtual std::vector<Eigen::Vector3d> forces() = 0;
};

/// Hash of positions and velocities: equal bits, equal hash.
std::uint64_t state_hash(const PointState& state);

}  // namespace dartboard
