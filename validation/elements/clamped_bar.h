#pragma once
// A bar of cubes that is held at one end, by every model of a body and by quadratic elements.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/plain/material.h"
#include "core/scene/body/simulated_body.h"
#include "reference/elements/held_solid.h"

namespace dartboard {

/// A box from the origin, held at x = 0 and pulled along z at its other end.
struct ClampedBar {
  std::array<int, 3> cubes{5, 1, 1};  // of the coarsest mesh, along each axis
  double spacing = 0.2;               // [m] their sides
  double young = 1e5;                 // [Pa]
  double density = 1000.0;            // [kg/m^3]

  double length() const { return cubes[0] * spacing; }
  double volume() const { return cubes[0] * cubes[1] * cubes[2] * spacing * spacing * spacing; }
  /// Number of nodes of a mesh whose cubes have sides of a `finer`-th.
  std::size_t nodes(int finer) const;
  /// The free corners of the coarsest cubes on the surface; every mesh has them.
  std::vector<Eigen::Vector3d> watched() const;
};

/// The pieces of the bar: springs or elements, of tetrahedra, six to a cube, or of the cubes.
struct BarModel {
  Model model = Model::springs;
  CellKind cells = CellKind::tetrahedron;
  double jitter = 0.0;  // [sides of a cube] of the inner nodes
};
/// "springs", "springs, jittered", "neo-hookean tetrahedra", "corotational hexahedra"
std::string in_words(const BarModel& model);
/// throws  InputError for words that are none of these
BarModel bar_model(const std::string& words);

/// The body of a model, held only by the clamp; neither gravity nor damping.
std::unique_ptr<SimulatedBody> bar_body(const ClampedBar& bar, const BarModel& model, int finer, double poisson);

/// The bar near rest: linear.
struct LinearBar {
  reference::HeldSolid solid;
  Eigen::VectorXd shear;               // [N] a traction of 1 Pa along z on the free end
  std::vector<std::uint32_t> watched;  // the nodes at ClampedBar::watched
};
/// By the stiffness of a body's own forces and masses, as it is simulated.
/// pre  the body is at rest
LinearBar linear_bar(const ClampedBar& bar, const BarModel& model, int finer, const SimulatedBody& body);
/// The body's vertices at ClampedBar::watched.
/// pre  the body is at rest
std::vector<std::uint32_t> watched_vertices(const ClampedBar& bar, const SimulatedBody& body);
/// By quadratic tetrahedra; their nodes are those of linear ones on a mesh twice as fine.
LinearBar quadratic_bar(const ClampedBar& bar, int finer, double poisson);

/// The modulus [Pa] of a slab that cannot expand sideways: E (1 - nu) / ((1 + nu) (1 - 2 nu)); and that of a model's
/// forces in this mesh of it, whose nodes stay in place under a uniform strain.
double confined_modulus(double young, double poisson);
double confined_modulus_of(const ClampedBar& bar, const SimulatedBody& body);

}  // namespace dartboard
