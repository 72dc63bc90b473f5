#pragma once
// Spring systems for tests: the columns of a body, or built by hand, with a motion.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/time/spring_system.h"
#include "core/views/cell_arrays.h"

namespace dartboard {

/// Owns what a SpringSystem and a Motion show.
struct SpringArrays {
  std::vector<SpringEnds> ends;
  std::vector<Spring> springs;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed;
  Eigen::Vector3d gravity{0, 0, 0};
  std::vector<Eigen::Vector3d> x, v;

  SpringSystem system() const { return {ends, springs, mass, inverse_mass, viscosity, fixed, gravity}; }
  Motion motion() { return {x, v}; }

  std::uint32_t add_vertex(double m, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity = {0, 0, 0},
                           bool held = false) {
    mass.push_back(m);
    inverse_mass.push_back(1.0 / m);
    viscosity.push_back(0.0);
    fixed.push_back(held);
    x.push_back(position);
    v.push_back(velocity);
    return static_cast<std::uint32_t>(mass.size() - 1);
  }
  void add_spring(std::uint32_t i, std::uint32_t j, double stiffness, double rest_length, double damping = 0.0) {
    ends.push_back({i, j});
    springs.push_back({rest_length, stiffness, damping});
  }
};

template <class Body>
SpringArrays arrays_of(const Body& body) {
  SpringArrays arrays;
  CellArrays cells;
  cells.rebuild(body);
  for (const EdgeEntry& edge : cells.edges) arrays.ends.push_back(edge.ends);
  arrays.springs = body.springs.list();
  arrays.mass = body.vertices.mass;
  arrays.inverse_mass = body.vertices.inverse_mass;
  arrays.viscosity = body.vertices.viscosity;
  arrays.fixed = body.vertices.fixed;
  arrays.gravity = body.surroundings.gravity;
  arrays.x = body.vertices.position;
  arrays.v = body.vertices.velocity;
  return arrays;
}

/// Off equilibrium in x and v: every coordinate moved by up to 0.05 and set going by up to 0.5, by fixed numbers.
inline void disturb(SpringArrays& arrays) {
  for (std::size_t i = 0; i < arrays.x.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto number = 3 * i + static_cast<std::size_t>(axis);
      arrays.x[i][axis] += 0.05 * (static_cast<double>(number * 37 % 101) / 50.0 - 1.0);
      arrays.v[i][axis] += 0.5 * (static_cast<double>(number * 53 % 103) / 51.0 - 1.0);
      if (arrays.fixed[i]) arrays.v[i][axis] = 0.0;
    }
}

}  // namespace dartboard
