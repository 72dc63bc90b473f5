#include "reference/exact_measure.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "reference/cell_shape.h"

namespace dartboard::reference {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Vector = std::array<Integer, 3>;

/// The points of a cell as whole numbers of 2^-shift metres.
struct WholePoints {
  std::vector<Vector> at;
  int shift = 0;
};

WholePoints whole_points(const Mesh& mesh, std::size_t c) {
  const auto cell = mesh.cell(c);
  WholePoints points;
  // a double is m 2^(e - 53) with a whole m of 53 bits
  int lowest = 0;
  for (const std::uint32_t p : cell)
    for (int k = 0; k < 3; ++k) {
      int exponent = 0;
      if (std::frexp(mesh.points[p][k], &exponent) != 0.0) lowest = std::min(lowest, exponent - 53);
    }
  points.shift = -lowest;
  for (const std::uint32_t p : cell) {
    Vector whole;
    for (int k = 0; k < 3; ++k) {
      int exponent = 0;
      const double fraction = std::frexp(mesh.points[p][k], &exponent);
      whole[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::ldexp(fraction, 53));
      if (fraction != 0.0) whole[static_cast<std::size_t>(k)] <<= static_cast<unsigned>(exponent - 53 - lowest);
    }
    points.at.push_back(whole);
  }
  return points;
}

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Integer dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector times(int factor, const Vector& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }

/// Four times the derivative of the trilinear map in direction `along`, where the two others are a / 2 and b / 2.
Vector derivative(const std::vector<Vector>& x, const std::array<int, 8>& corner, std::size_t along, int a, int b) {
  const std::size_t first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
  const auto node = [&](std::size_t at) -> const Vector& { return x[static_cast<std::size_t>(corner[at])]; };
  Vector d{0, 0, 0};
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) {
      const std::size_t low = (p << first) + (q << second), high = low + (std::size_t{1} << along);
      const int weight = (p == 0 ? 2 - a : a) * (q == 0 ? 2 - b : b);
      d = sum(d, times(weight, node(high) - node(low)));
    }
  return d;
}

}  // namespace

Rational exact_volume(const Mesh& mesh, std::size_t c) {
  const WholePoints points = whole_points(mesh, c);
  const auto& x = points.at;
  const auto in_cubic_metres = [&](const Integer& whole, int divisor) {
    return Rational(whole, Integer(divisor) << static_cast<unsigned>(3 * points.shift));
  };
  if (mesh.kinds[c] == CellKind::tetrahedron)  // the Jacobian's integral is a sixth of it
    return in_cubic_metres(dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]), 6);
  // The determinant is of degree 2 in each coordinate, where Simpson's rule (1, 4, 1) / 6 is exact.
  const auto corner = corners_of(mesh.kinds[c]);
  constexpr std::array<int, 3> weight{1, 4, 1};
  Integer sum_of_dets = 0;
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      for (int t = 0; t < 3; ++t)
        sum_of_dets +=
            weight[static_cast<std::size_t>(r)] * weight[static_cast<std::size_t>(s)] *
            weight[static_cast<std::size_t>(t)] *
            dot(cross(derivative(x, corner, 0, s, t), derivative(x, corner, 1, r, t)), derivative(x, corner, 2, r, s));
  return in_cubic_metres(sum_of_dets, 6 * 6 * 6 * 4 * 4 * 4);
}

double exact_measure(const Mesh& mesh, std::size_t c) {
  if (dimension(mesh.kinds[c]) == 3) return std::abs(rounded(exact_volume(mesh, c)));
  // twice the area vector of a polygon of three or four corners is the cross product of two sides, or of its diagonals
  const WholePoints points = whole_points(mesh, c);
  const auto& x = points.at;
  const Vector twice = x.size() == 3 ? cross(x[1] - x[0], x[2] - x[0]) : cross(x[2] - x[0], x[3] - x[1]);
  using Wide = boost::multiprecision::cpp_bin_float_100;
  const Wide length = sqrt(Wide(dot(twice, twice)));
  return static_cast<double>(ldexp(length, -2 * points.shift - 1));
}

// Rounding as in summation_bound.cpp. A tetrahedron: each of the six products of the determinant has 3 roundings of
// edges, 2 of products, 3 of sums, and the sixth 1: gamma_9 of their absolute values, which sum up to 1.16 times the
// product of the edges' lengths at most (a permanent of unit rows): 11 u |e1| |e2| |e3| / 6.
//
// Other volumes are 24 tetrahedra at most, D the diameter: two of the edges from the middle of a face are 3/4 D at
// most, the third D. The middle is off by 5 u D and the centre by 9, which moves the determinant by
// (5 * 3/4 + 5 * 3/4 + 14 * 9/16) u D^3, in addition to its own 11 * 9/16: 21.6 u D^3 each, 87 u D^3 in all, and
// their sum another 24 u of 24 / 6 * 9/16 D^3 at worst; their volumes add up to the cell's, so 3 u D^3 is enough.
//
// A polygon: two triangles at most, each cross product with 2 edges, 1 product, 1 difference: 4 u times 2 D^2; their
// sum, the norm and the half: 5 u of 2 D^2.
double measure_rounding(const Mesh& mesh, std::size_t c) {
  constexpr double u = 0x1p-53;
  const auto cell = mesh.cell(c);
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (mesh.points[cell[a]] - mesh.points[cell[b]]).norm();
  };
  if (mesh.kinds[c] == CellKind::tetrahedron) return 11.01 * u * distance(1, 0) * distance(2, 0) * distance(3, 0) / 6.0;
  double diameter = 0.0;
  for (std::size_t a = 0; a < cell.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) diameter = std::max(diameter, distance(a, b));
  if (dimension(mesh.kinds[c]) == 2) return 18.0 * u * diameter * diameter;
  return 90.0 * u * diameter * diameter * diameter;
}

double rounded(const Rational& x) {
  if (x == 0) return 0.0;
  // 64 bits of the quotient and one for a remainder other than zero, so that the conversion rounds once
  const Integer size = abs(numerator(x));
  const int excess = static_cast<int>(msb(size)) - static_cast<int>(msb(denominator(x)));
  const int up = 64 - excess;
  Integer quotient, rest;
  divide_qr(up > 0 ? Integer(size << static_cast<unsigned>(up)) : size,
            up < 0 ? Integer(denominator(x) << static_cast<unsigned>(-up)) : Integer(denominator(x)), quotient, rest);
  // 2^63 <= quotient < 2^65: to 53 bits and the bit below by hand
  const int dropped = static_cast<int>(msb(quotient)) - 52;
  auto kept = static_cast<std::uint64_t>(quotient >> static_cast<unsigned>(dropped));
  const Integer tail = quotient - (Integer(kept) << static_cast<unsigned>(dropped));
  const Integer half = Integer(1) << static_cast<unsigned>(dropped - 1);
  if (tail > half || (tail == half && (rest != 0 || kept % 2 == 1))) ++kept;
  const double value = std::ldexp(static_cast<double>(kept), dropped - up);
  return x < 0 ? -value : value;
}

}  // namespace dartboard::reference
