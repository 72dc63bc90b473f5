#pragma once
// A clamped beam by every model of a body, compared with quadratic elements: the errors of a model.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "validation/elements/clamped_bar.h"

namespace dartboard {

/// 1 x 0.2 x 0.2 m, held at x = 0, 1e5 Pa, 1000 kg/m^3.
namespace cantilever {
inline constexpr double length = 1.0, side = 0.2, young = 1e5, density = 1000.0;
inline constexpr ClampedBar bar{{5, 1, 1}, side, young, density};
}  // namespace cantilever

/// Answers on the beam: linear, near rest.
struct CantileverAnswers {
  std::size_t nodes = 0;
  double work = 0.0;                  // [J] done by a shear traction of 1 Pa on the end face
  std::array<double, 6> frequency{};  // [1/s] the lowest: two bendings, torsion, two bendings, along the axis
};

/// From a mesh of `across` cubes of six tetrahedra across the beam.
CantileverAnswers quadratic_cantilever(int across, double poisson);
/// With the stiffness of a model's own forces and masses at the vertices, as it is simulated; of tetrahedra,
/// or of the cubes as hexahedra.
CantileverAnswers cantilever_of(Model model, int across, double poisson, CellKind cells = CellKind::tetrahedron);

/// Results of scikit-fem 12.0.2 with 27-node hexahedra, 6 across (reference/elements/values); the edges of the clamp
/// are singular, so that such numbers are some 0.1 % off (0.4 % at 0.45).
struct PublishedCantilever {
  double poisson, work, first, torsion, second, axial;
};
inline constexpr std::array<PublishedCantilever, 3> published_cantilevers{
    {{0.25, 4.0801e-5, 1.98303, 9.15479, 10.73468, 15.76598},
     {0.30, 4.0665e-5, 1.98710, 8.97822, 10.71319, 15.79413},
     {0.45, 3.9919e-5, 2.01056, 8.50750, 10.69368, 15.93341}}};

/// The body of a model, held only by the clamp.
std::unique_ptr<SimulatedBody> cantilever_body(Model model, int across, double poisson,
                                               CellKind cells = CellKind::tetrahedron);

/// The confined modulus of its material, and that of a model's forces in tetrahedra.
double confined_modulus(double poisson);
double confined_modulus_of(Model model, double poisson);

}  // namespace dartboard
