#pragma once
// A body of elements as bare columns, from a mesh of tetrahedra: no map.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/elements/tetrahedra.h"
#include "core/plain/mesh.h"
#include "core/plain/random.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

struct ElementBody {
  // on the heap: the term keeps pointers to them when the body is moved
  struct Columns {
    std::vector<TetrahedronNodes> nodes;
    std::vector<RestShape> shape;
    std::vector<double> mass;
  };
  std::unique_ptr<Columns> columns = std::make_unique<Columns>();
  std::vector<TetrahedronNodes>& nodes = columns->nodes;
  std::vector<RestShape>& shape = columns->shape;
  std::vector<double>& cell_mass = columns->mass;

  Material material;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed;
  std::vector<Eigen::Vector3d> rest, x, v;
  Eigen::Vector3d gravity{0, 0, 0};
  std::unique_ptr<ForceTerm> term;
  const ForceTerm* terms = nullptr;

  ElementBody(const Mesh& mesh, Model model, double young, double poisson, double density = 1000.0,
              double damping_time = 0.0) {
    material = {.density = density,
                .stiffness = 0.0,
                .damping = 0.0,
                .young = young,
                .poisson = poisson,
                .model = model,
                .damping_time = damping_time};
    rest = x = mesh.points;
    v.assign(x.size(), Eigen::Vector3d(0, 0, 0));
    mass.assign(x.size(), 0.0);
    fixed.assign(x.size(), 0);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto cell = mesh.cell(c);
      nodes.push_back({cell[0], cell[1], cell[2], cell[3]});
      shape.push_back(rest_shape_of(x[cell[0]], x[cell[1]], x[cell[2]], x[cell[3]]));
      cell_mass.push_back(density * std::abs(signed_measure(mesh, c)));
      for (const std::uint32_t i : cell) mass[i] += cell_mass.back() / 4;
    }
    for (const double m : mass) inverse_mass.push_back(1.0 / m);
    term = make_tetrahedra(material, {nodes, shape, cell_mass});
    terms = term.get();
  }

  SpringSystem system() const {
    return {.ends = {},
            .springs = {},
            .mass = mass,
            .inverse_mass = inverse_mass,
            .viscosity = viscosity,
            .fixed = fixed,
            .gravity = gravity,
            .terms = {&terms, 1}};
  }
  Motion motion() { return {x, v}; }
  /// Moves every coordinate by up to `size`, from a seed.
  void shake(double size, std::uint64_t seed) {
    SplitMix64 random(seed);
    for (Eigen::Vector3d& p : x)
      for (double& c : p) c += size * random.next_signed();
  }
};

/// No net force and no torque, except for a rounding of the terms.
inline void expect_no_net_pull(std::span<const Eigen::Vector3d> force, std::span<const Eigen::Vector3d> x,
                               std::string_view what) {
  Eigen::Vector3d sum(0, 0, 0), torque(0, 0, 0);
  double size = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    sum += force[i];
    torque += x[i].cross(force[i]);
    size += force[i].norm();
  }
  EXPECT_LE(sum.norm(), 1e-15 * size) << what;
  EXPECT_LE(torque.norm(), 1e-15 * size) << what;
}

inline constexpr std::array element_models{Model::neo_hookean, Model::corotational, Model::stvk};

}  // namespace dartboard
