#pragma once
// The paper's naive baseline (section 5.1): points and springs in arrays, with the ends of springs given by index.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/problem.h"
#include "reference/rebuild.h"

namespace dartboard::reference {

/// A mass/spring body with no topology but the end points of its springs, moved by classical Runge-Kutta of order 4.
/// It serves twice: as the contender to beat, and as an implementation of the mechanics that shares no code with core.
class AdjacencyGraph {
 public:
  /// throws  InputError if the mesh is malformed, `fixed` names no point, the velocities are not one per point, h is
  ///         not positive, or a free point has no mass
  explicit AdjacencyGraph(const Problem& problem);

  /// Advance by n time steps.
  void step(int n);

  PointState state() const;

  /// Continue from `state`; fixed points take its positions and stay still.
  ///
  /// throws  InputError if `state` has another number of points
  void set_state(const PointState& state);

  /// f_i - viscosity m_i v_i [N] at the current state, for every point, also the fixed.
  std::vector<Eigen::Vector3d> spring_and_drag_forces() const;

  std::size_t nodes() const { return nodes_.size(); }
  std::size_t springs() const { return springs_.size(); }
  std::size_t cells() const { return cells_; }
  std::span<const double> masses() const { return masses_; }        // kg, per point
  std::span<const Spring> spring_list() const { return springs_; }  // ascending in the end points

 private:
  struct Node {
    Eigen::Vector3d x, v;    // at the start of the step
    Eigen::Vector3d force;   // of the springs, at the stage
    Eigen::Vector3d xs, vs;  // at the stage; equal to x, v between steps
    Eigen::Vector3d dx, dv;  // the sums of the step
    double inverse_mass;
    bool fixed;
  };

  void pull_springs();
  void advance(double weight, double next, bool first);
  void finish(double weight);
  Eigen::Vector3d acceleration(const Node& node) const {
    return node.force * node.inverse_mass - viscosity_ * node.vs + gravity_;
  }

  std::vector<Node> nodes_;
  std::vector<Spring> springs_;
  std::vector<double> masses_;
  std::size_t cells_;
  double viscosity_, h_;
  Eigen::Vector3d gravity_;
};

}  // namespace dartboard::reference
