#pragma once
// Spring systems for the tests of implicit methods.

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/meshes_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard {

/// Two free masses on the x axis, at rest length 2 and stretched by `amplitude`: omega^2 = k / (m1 m2 / (m1 + m2)).
inline SpringArrays two_masses(double m1, double m2, double stiffness, double amplitude, double damping = 0.0) {
  SpringArrays body;
  body.add_vertex(m1, {0, 0, 0});
  body.add_vertex(m2, {2 + amplitude, 0, 0});
  body.add_spring(0, 1, stiffness, 2.0, damping);
  return body;
}

/// nx x ny x nz cubes of six tetrahedra, spacing 0.1 m, with a spring per edge and, for each cell around an edge,
/// `stiffness` and `damping`; a mass of 0.02 kg per point.
inline SpringArrays spring_grid(int nx, int ny, int nz, double stiffness = 50.0, double damping = 0.0,
                                double jitter = 0.05) {
  return columns_of_mesh(reference::kuhn_grid(nx, ny, nz, 0.1, jitter, 7), 0.02, stiffness, damping);
}

/// Every other spring of a vertex, and half of its mass, go to a new vertex at the same place, as in a dissociation.
inline void dissociate(SpringArrays& body, std::uint32_t vertex) {
  const std::uint32_t added = body.add_vertex(body.mass[vertex] / 2, body.x[vertex], body.v[vertex]);
  body.set_mass(vertex, body.mass[vertex] / 2);
  bool leaves = false;
  for (SpringEnds& ends : body.ends)
    for (std::uint32_t& end : ends)
      if (end == vertex && (leaves = !leaves)) end = added;
}

/// Move every free vertex by at most `size` [m], and give it a velocity of at most `speed` [m/s], in each coordinate.
inline void disturb(SpringArrays& body, double size, double speed, unsigned seed = 1) {
  std::mt19937 bits(seed);
  const auto draw = [&bits] { return static_cast<double>(bits()) / 2147483648.0 - 1.0; };
  for (std::size_t i = 0; i < body.x.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double dx = size * draw(), dv = speed * draw();
      if (body.fixed[i]) continue;
      body.x[i][c] += dx;
      body.v[i][c] += dv;
    }
}

/// A vector field of plain numbers for right-hand sides.
inline std::vector<Eigen::Vector3d> random_vectors(std::size_t n, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<Eigen::Vector3d> result(n);
  for (auto& p : result)
    for (int c = 0; c < 3; ++c) p[c] = static_cast<double>(bits()) / 2147483648.0 - 1.0;
  return result;
}

/// A grid whose springs are longer at rest than it has room for.
inline SpringArrays crushed_grid(double size) {
  SpringArrays body = spring_grid(2, 2, 2);
  for (Eigen::Vector3d& p : body.x) p *= size;
  disturb(body, 0.01, 1.0);
  return body;
}

}  // namespace dartboard
