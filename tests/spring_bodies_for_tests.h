#pragma once
// Spring systems for the tests of implicit methods.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "tests/meshes_for_tests.h"
#include "tests/spring_arrays_for_tests.h"

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
  const Mesh mesh = reference::kuhn_grid(nx, ny, nz, 0.1, jitter, 7);
  SpringArrays body;
  for (const Eigen::Vector3d& p : mesh.points) body.add_vertex(0.02, p);
  std::map<SpringEnds, int> cells_around;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        ++cells_around[{std::min(nodes[i], nodes[j]), std::max(nodes[i], nodes[j])}];
  }
  for (const auto& [ends, count] : cells_around)
    body.add_spring(ends[0], ends[1], stiffness * count, (body.x[ends[1]] - body.x[ends[0]]).norm(), damping * count);
  return body;
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

/// A numbers-only vector field for right-hand sides.
inline std::vector<Eigen::Vector3d> random_vectors(std::size_t n, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<Eigen::Vector3d> result(n);
  for (auto& p : result)
    for (int c = 0; c < 3; ++c) p[c] = static_cast<double>(bits()) / 2147483648.0 - 1.0;
  return result;
}

}  // namespace dartboard
