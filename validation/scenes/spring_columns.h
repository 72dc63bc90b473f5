#pragma once
// Systems of springs and elements built by hand, in columns of their own.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/plain/mesh.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

class ElasticSolid;

/// Owns the arrays that a SpringSystem and a Motion refer to.
struct SpringColumns {
  std::vector<SpringEnds> ends;
  std::vector<Spring> springs;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed;
  Eigen::Vector3d gravity{0, 0, 0};
  std::vector<Eigen::Vector3d> x, v;
  std::shared_ptr<const ElasticSolid> solid{};  // elements besides the springs
  std::vector<const ForceTerm*> terms{};        // of the solid
  std::vector<HeldAxes> held_axes{};            // empty where no axis is held

  SpringSystem system() const {
    return {ends, springs, mass, inverse_mass, viscosity, fixed, gravity, {}, terms, held_axes};
  }
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
  void set_mass(std::size_t vertex, double value) {
    mass[vertex] = value;
    inverse_mass[vertex] = 1.0 / value;
  }
};

/// A mesh of simplices at rest: a mass of `mass` [kg] for each point, and between any two points of a cell a spring
/// with `stiffness` [N/m] and `damping` [kg/s] for each cell that has both.
inline SpringColumns columns_of_mesh(const Mesh& mesh, double mass, double stiffness, double damping = 0.0) {
  SpringColumns body;
  for (const Eigen::Vector3d& p : mesh.points) body.add_vertex(mass, p);
  std::map<SpringEnds, int> cells_around;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j)
        ++cells_around[{std::min(nodes[i], nodes[j]), std::max(nodes[i], nodes[j])}];
  }
  for (const auto& [ends, count] : cells_around)
    body.add_spring(ends[0], ends[1], stiffness * count, (body.x[ends[1]] - body.x[ends[0]]).norm(), damping * count);
  return body;
}

}  // namespace dartboard
