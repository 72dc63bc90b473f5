#pragma once
// The classical Runge-Kutta method of order 4, the paper's integrator (section 5.1), over any walk.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/plain/error.h"
#include "core/walks/spring_forces.h"

namespace dartboard {

/// One step of the classical Runge-Kutta method: x' = v, v' = a(x, v).
///
/// Each of the four stages covers the edges once for the forces and the vertices once for everything else. Springs
/// along edges are all the forces that a walk meets: bodies of elements, membranes or diagonals are stepped by the
/// integrators of core/time over their system.
///
/// throws  InputError for a body with anything but springs along its edges, or vertices held along axes
/// order   4; stable on the imaginary axis up to h omega = 2 sqrt(2)
/// cost    4 force evaluations
class RungeKutta4 {
 public:
  template <class Walk, class Body>
  void step(const Walk& walk, Body& body, double h) {
    if (has_elements(body.elements) || !body.cell_springs.empty())
      throw InputError(
          "RungeKutta4 supports only springs along edges, and the body has other forces; expected an "
          "integrator of core/time over its system");
    VertexColumns& v = body.vertices;
    if (!v.held_axes.empty())
      throw InputError(
          "RungeKutta4 holds vertices still or not at all, and the body has some that are held along axes; expected an "
          "integrator of core/time over its system");
    for (auto* column : {&x0_, &v0_, &sum_x_, &sum_v_}) column->resize(v.size());
    const Eigen::Vector3d gravity = body.surroundings.gravity;

    add_spring_forces(walk, body);
    walk.for_each_vertex(body, [&](std::uint32_t i) {
      const Eigen::Vector3d a = take_acceleration(v, gravity, i);
      x0_[i] = v.position[i];
      v0_[i] = v.velocity[i];
      sum_x_[i] = v0_[i];
      sum_v_[i] = a;
      v.position[i] = x0_[i] + (h / 2) * v0_[i];
      v.velocity[i] = v0_[i] + (h / 2) * a;
    });
    for (const double reach : {h / 2, h}) {  // to the stage that follows
      add_spring_forces(walk, body);
      walk.for_each_vertex(body, [&](std::uint32_t i) {
        const Eigen::Vector3d a = take_acceleration(v, gravity, i);
        sum_x_[i] += 2.0 * v.velocity[i];
        sum_v_[i] += 2.0 * a;
        v.position[i] = x0_[i] + reach * v.velocity[i];
        v.velocity[i] = v0_[i] + reach * a;
      });
    }
    add_spring_forces(walk, body);
    walk.for_each_vertex(body, [&](std::uint32_t i) {
      const Eigen::Vector3d a = take_acceleration(v, gravity, i);
      v.position[i] = x0_[i] + (h / 6) * (sum_x_[i] + v.velocity[i]);
      v.velocity[i] = v0_[i] + (h / 6) * (sum_v_[i] + a);
    });
  }

 private:
  // The acceleration, leaving the force sum empty for the next stage.
  static Eigen::Vector3d take_acceleration(VertexColumns& v, const Eigen::Vector3d& gravity, std::uint32_t i) {
    Eigen::Vector3d a = acceleration(v, gravity, i);
    v.force[i].setZero();
    return a;
  }

  std::vector<Eigen::Vector3d> x0_, v0_, sum_x_, sum_v_;  // start of the step, weighted sums of the stages
};

}  // namespace dartboard
