// Why an array of node structures. RK4 on liver564 (564 points, 2850 springs), one thread of an AMD EPYC, gcc 12 -O3,
// processor time per step, median of 15 interleaved rounds of 300 steps; all are plain loops:
//
//     one structure per node, one per spring                          0.0526 ms   <- this one
//     an array of vectors per quantity (x, v, force, ...)             0.0548
//     rows: springs grouped by first end point, its force in registers  0.0557
//     positions and velocities in one structure, forces apart         0.0567
//     blocks of 64 springs in contiguous temporaries                  0.0813  (0.067 with -fno-math-errno)
//
// The order is the same on 17576 points and 115075 springs (2.20 to 3.32 ms). More important than the layout is the
// length of the chain of dependent operations: (s / l) * d instead of s * (d / l) took the first row from 0.0630.

#include "reference/adjacency_graph.h"

#include <fmt/format.h>

#include <utility>

#include "core/plain/error.h"

namespace dartboard::reference {
namespace {

// The force of the spring on its end a; end b gets the opposite. Without the hint GCC leaves a call in the loop, which
// takes a fifth longer.
inline Eigen::Vector3d pull(const Spring& spring, const Eigen::Vector3d& xa, const Eigen::Vector3d& va,
                            const Eigen::Vector3d& xb, const Eigen::Vector3d& vb) {
  const Eigen::Vector3d d = xb - xa;
  const double l = d.norm();
  if (l == 0.0) return Eigen::Vector3d::Zero();
  const double inverse = 1.0 / l;
  const double rate = (vb - va).dot(d) * inverse;
  return ((spring.stiffness * (l - spring.rest_length) + spring.damping * rate) * inverse) * d;
}

}  // namespace

AdjacencyGraph::AdjacencyGraph(const Problem& problem)
    : cells_(problem.mesh.cell_count()),
      viscosity_(problem.material.viscosity),
      h_(problem.h),
      gravity_(problem.surroundings.gravity) {
  const auto& points = problem.mesh.points;
  if (!problem.initial_velocity.empty() && problem.initial_velocity.size() != points.size())
    throw InputError(
        fmt::format("{} initial velocities for {} points", problem.initial_velocity.size(), points.size()));
  if (!(h_ > 0.0)) throw InputError(fmt::format("the time step {} is not > 0", h_));

  Rebuilt body = rebuild(problem.mesh, problem.material);
  springs_ = std::move(body.springs);
  masses_ = std::move(body.mass);

  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  nodes_.assign(points.size(), {zero, zero, zero, zero, zero, zero, zero, 0.0, false});
  for (std::uint32_t p : problem.fixed) {
    if (p >= nodes_.size())
      throw InputError(fmt::format("fixed point {} does not exist, there are {}", p, nodes_.size()));
    nodes_[p].fixed = true;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].fixed) continue;
    if (!(masses_[i] > 0.0)) throw InputError(fmt::format("the mass of point {} is {}, not > 0", i, masses_[i]));
    nodes_[i].inverse_mass = 1.0 / masses_[i];
  }

  PointState start{points, problem.initial_velocity};
  start.v.resize(points.size(), zero);
  set_state(start);
}

void AdjacencyGraph::step(int n) {
  for (; n > 0; --n) {
    pull_springs();
    advance(h_ / 6.0, h_ / 2.0, true);
    pull_springs();
    advance(h_ / 3.0, h_ / 2.0, false);
    pull_springs();
    advance(h_ / 3.0, h_, false);
    pull_springs();
    finish(h_ / 6.0);
  }
}

void AdjacencyGraph::pull_springs() {
  for (Node& node : nodes_) node.force.setZero();
  for (const Spring& spring : springs_) {
    Node& a = nodes_[spring.a];
    Node& b = nodes_[spring.b];
    const Eigen::Vector3d f = pull(spring, a.xs, a.vs, b.xs, b.vs);
    a.force += f;
    b.force -= f;
  }
}

// Add this stage to the step with its weight, and go `next` seconds from the start of the step along it.
void AdjacencyGraph::advance(double weight, double next, bool first) {
  for (Node& node : nodes_) {
    if (node.fixed) continue;
    const Eigen::Vector3d a = acceleration(node);
    const Eigen::Vector3d v = node.vs;
    if (first) {
      node.dx = weight * v;
      node.dv = weight * a;
    } else {
      node.dx += weight * v;
      node.dv += weight * a;
    }
    node.xs = node.x + next * v;
    node.vs = node.v + next * a;
  }
}

void AdjacencyGraph::finish(double weight) {
  for (Node& node : nodes_) {
    if (node.fixed) continue;
    node.x += node.dx + weight * node.vs;
    node.v += node.dv + weight * acceleration(node);
    node.xs = node.x;
    node.vs = node.v;
  }
}

PointState AdjacencyGraph::state() const {
  PointState out;
  for (const Node& node : nodes_) {
    out.x.push_back(node.x);
    out.v.push_back(node.v);
  }
  return out;
}

void AdjacencyGraph::set_state(const PointState& state) {
  if (state.x.size() != nodes_.size() || state.v.size() != nodes_.size())
    throw InputError(fmt::format("a state of {} positions and {} velocities for {} points", state.x.size(),
                                 state.v.size(), nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    node.x = node.xs = state.x[i];
    node.v = node.vs = node.fixed ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : state.v[i];
  }
}

std::vector<Eigen::Vector3d> AdjacencyGraph::spring_and_drag_forces() const {
  std::vector<Eigen::Vector3d> f(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) f[i] = -viscosity_ * masses_[i] * nodes_[i].v;
  for (const Spring& spring : springs_) {
    const Node& a = nodes_[spring.a];
    const Node& b = nodes_[spring.b];
    const Eigen::Vector3d along = pull(spring, a.x, a.v, b.x, b.v);
    f[spring.a] += along;
    f[spring.b] -= along;
  }
  return f;
}

}  // namespace dartboard::reference
