#pragma once
// Spring systems for tests: the columns of a body, or built by hand, with a motion.

#include "core/mechanics/mass_spring_body.h"
#include "core/walks/cell_arrays.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

using SpringArrays = SpringColumns;

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

/// Off equilibrium in x and v: every coordinate changed by up to 0.05, every velocity by up to 0.5, by fixed numbers.
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
