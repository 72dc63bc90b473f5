#pragma once
// A solid that is held and loaded, in a form that any program can read.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/plain/material.h"
#include "core/plain/mesh.h"
#include "core/scene/body/simulated_body.h"

namespace dartboard {

/// Linear tetrahedra or hexahedra of an elastic material, some points held, forces of constant direction on others.
struct StaticProblem {
  Mesh mesh;
  double young = 1e5, poisson = 0.3;   // [Pa]
  std::vector<std::uint32_t> held{};   // points, ascending
  std::vector<Eigen::Vector3d> force;  // [N] on each point
  bool large = false;                  // large displacements, in St. Venant-Kirchhoff's law; else linear
  static constexpr int parts = 10;     // of the load, where displacements are large
};

/// A beam of 1 x 0.2 x 0.2 m held at x = 0, `across` cubes wide, whose inner points are moved at random. A traction
/// [Pa] across its other end, sideways too, is shared by the points there.
StaticProblem loaded_beam(CellKind cells, int across, double traction, bool large);

/// The traction [Pa] that bends such a beam to some 0.6 of its length, for two or four cubes across: coarse meshes are
/// stiffer, tetrahedra most.
double bends_far(CellKind cells, int across);

/// The body of a problem as core simulates it, at rest; and the force [N] on each of its vertices.
std::unique_ptr<SimulatedBody> body_of(const StaticProblem& problem, Model model);
std::vector<Eigen::Vector3d> forces_on(const StaticProblem& problem, const SimulatedBody& body);

/// The displacements [m] of the points of a problem, by core's elements: tangents and forces as they are simulated.
/// throws  SolverError if Newton's method does not converge
std::vector<Eigen::Vector3d> displacements_by_core(const StaticProblem& problem);

/// The largest distance of two displacements over the largest of the second ones; NaN if their numbers differ.
double displacements_apart(std::span<const Eigen::Vector3d> u, std::span<const Eigen::Vector3d> truth);
/// The largest displacement [m].
double largest_displacement(std::span<const Eigen::Vector3d> u);

}  // namespace dartboard
