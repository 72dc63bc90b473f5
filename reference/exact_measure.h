#pragma once
// Volumes and areas of cells in exact rationals, from the points alone: no table of faces, no rounding.

#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard::reference {

using Rational = boost::multiprecision::cpp_rational;

/// The signed volume of a 3D cell, positive when right-handed, as the integral of the Jacobian of its trilinear map.
///
/// Every kind is a hexahedron some of whose nodes coincide, so one formula serves all, and it needs no faces.
/// Quadrilaterals are the bilinear patches through their corners, which halve the tetrahedron of these corners: the
/// volume is that of a split from the centroids of the faces, and of the mean of both splits along diagonals.
///
/// pre  the points are finite
Rational exact_volume(const Mesh& mesh, std::size_t c);

/// The measure of a cell, rounded once, or twice for a polygon: a volume [m^3] or, for a polygon, half the length of
/// the sum of the cross products along its sides [m^2]. Positive whatever the handedness.
double exact_measure(const Mesh& mesh, std::size_t c);

/// A bound of the difference between the measure of core/plain and this one, by the rounding of its formula (the
/// derivation is in the source), in m^3 or m^2.
double measure_rounding(const Mesh& mesh, std::size_t c);

/// The nearest double.
double rounded(const Rational& x);

}  // namespace dartboard::reference
