#pragma once
// Force terms across the inner edges of a surface: quadratic bending, and springs between second neighbours.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/forces/force_term.h"

namespace dartboard {

/// Two triangles and the edge that they share. The energy is |b|^2 / 2 with b = sum of c_i (x_i - x_0) over i = 1, 2,
/// 3: zero wherever the two are flat, by linearity in any affine image of them.
struct BendingEdge {
  std::array<std::uint32_t, 4> nodes{};  // the ends of the edge, the corners across; all 0 if there is no such pair
  std::array<double, 3> c{};             // [sqrt(N / m)]

  bool empty() const { return nodes[0] == nodes[1]; }
  friend bool operator==(const BendingEdge&, const BendingEdge&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(nodes, c);
  }
};

/// The coefficients for ends x0, x1 of an edge e and corners x2, x3 across it, all at rest, flat and far from a line.
///
/// With slopes measured along the heights h2, h3, the jump theta of the slope is linear in the places; the energy is
/// rigidity |e|^2 / (A2 + A3) theta^2 / 2, A the areas. A sheet of equal-sided triangles then has that rigidity against
/// any cylinder; for others it depends on the direction: squares halved all the same way have it along their sides and
/// along the diagonals that halve them, and three times that along the other diagonals.
/// units   rigidity [N m]
/// source  Bergou et al. 2006, A quadratic bending model for inextensible surfaces: its coefficients without the factor
///         3, which makes a sheet three times as stiff as its rigidity
std::array<double, 3> bending_coefficients(double rigidity, const Eigen::Vector3d& x0, const Eigen::Vector3d& x1,
                                           const Eigen::Vector3d& x2, const Eigen::Vector3d& x3);

/// The term reads the edges anew in each call. Its stiffness is a constant matrix, positive semidefinite.
/// It has no virial: a moment is no tension.
std::unique_ptr<ForceTerm> make_bending(const std::vector<BendingEdge>& edges);

/// The springs across one inner edge, between the two corners next to each of its ends: second neighbours by that end.
/// For two triangles it is the same pair twice, and one spring; others have half the stiffness, the other half being
/// across the edge on the other side of that end. A cut through the edge takes them, one along the springs shares them.
struct SecondNeighbours {
  std::uint32_t count = 0;               // of vertices: 0 if there is no such pair, 2 or 4
  std::array<std::uint32_t, 4> nodes{};  // one spring from the first to the second, another between the next two
  std::array<double, 2> rest_length{};   // [m]

  friend bool operator==(const SecondNeighbours&, const SecondNeighbours&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(count, nodes, rest_length);
  }
};

/// Springs of this stiffness [N/m]. They hold a flat sheet flat by their length alone, which varies with the square of
/// the curvature: their energy varies with its fourth power, and a sheet that is hardly bent hardly resists.
/// source  Provot, Deformation constraints in a mass-spring model, 1995, as section 3.1 cites it
std::unique_ptr<ForceTerm> make_second_neighbours(const std::vector<SecondNeighbours>& edges, double stiffness);

}  // namespace dartboard
