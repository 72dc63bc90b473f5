#pragma once
// The sums that operations must conserve, and how far rounding may move them.
//
// Rounding in the usual way: u = 2^-53, gamma_n = n u / (1 - n u), and "n" stands for a relative error of gamma_n. What
// a body holds counts as exact data: the share s_c of a node in the mass of its cell, positions, velocities, the
// stiffness kappa and damping that one cell contributes. In exact arithmetic every sum is then one over the cells:
//
//     sum_v m_v g(x_v, v_v) = sum over the cells c and their corners of s_c g,   because m_v is the sum of its shares,
//     sum_e k_e e_e^2 / 2   = sum over the cells and their edges of kappa e^2 / 2,  because k_e counts its cells.
//
// A dissociation shares the corners of a vertex out between its parts and leaves x, v, and so every elongation, the
// same in both, bit for bit (exchanging the ends of a spring only changes signs). So neither sum changes, and a removal
// takes away the terms of the removed cell. What the computed terms deviate by, with at most n cells around a vertex:
//
//     mass                n - 1   the sum of its shares
//     momentum            n       and one product
//     angular momentum    n + 2   and two products, one difference, relative to m (|x_j v_k| + |x_k v_j|)
//     kinetic energy      n + 3   three products, two sums (3 in a row), times m; the half is exact
//     stiffness, damping  1       one product, cells times kappa
//     elastic energy      2       and one; the square of the elongation is data, the same bits in all parts
//     boundary            0       areas and lengths are data
//
// Sums are twofold: the result of N terms is off by at most u |s| + gamma_N^2 sum |t| (Ogita, Rump and Oishi 2005,
// Sum2), below 2 u sum |t| for N < 2^25. With 2 more for after - before + removed:
//
//     |after - before + removed| <= gamma_{index + 4} (sum |t| before + sum |t| after + sum |t| removed)
//
// Sums of whole multiples of one power of two q that stay below 2^53 q are exact: there the bound is zero.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/plain/nan_maximum.h"

namespace dartboard {

/// gamma_n; n u < 1.
constexpr double gamma(std::size_t n) {
  const double nu = static_cast<double>(n) * 0x1p-53;
  return nu / (1.0 - nu);
}

/// A sum in two doubles, and the sum of the absolute values.
struct TwofoldSum {
  double high = 0.0, low = 0.0, magnitude = 0.0;

  void add(double term) {
    const double sum = high + term, part = sum - high;
    low += (high - (sum - part)) + (term - part);  // the exact rounding error of the addition
    high = sum;
    magnitude += std::abs(term);
  }
  double value() const { return high + low; }
};

enum class Conserved {
  mass,
  stiffness,
  damping,
  momentum_x,
  momentum_y,
  momentum_z,
  spin_x,
  spin_y,
  spin_z,
  kinetic,
  elastic,
  boundary
};
inline constexpr std::size_t conserved_count = 12;

struct ConservedSums {
  std::array<TwofoldSum, conserved_count> sums;

  TwofoldSum& operator[](Conserved c) { return sums[static_cast<std::size_t>(c)]; }
  const TwofoldSum& operator[](Conserved c) const { return sums[static_cast<std::size_t>(c)]; }

  /// Adds a vertex, or the share that one cell has in it.
  void add_node(double mass, const Eigen::Vector3d& x, const Eigen::Vector3d& v) {
    (*this)[Conserved::mass].add(mass);
    add_vector(Conserved::momentum_x, mass * v, (mass * v).cwiseAbs());
    const auto part = [&](int j, int k) { return mass * (x[j] * v[k] - x[k] * v[j]); };
    const auto size = [&](int j, int k) { return mass * (std::abs(x[j] * v[k]) + std::abs(x[k] * v[j])); };
    add_vector(Conserved::spin_x, {part(1, 2), part(2, 0), part(0, 1)}, {size(1, 2), size(2, 0), size(0, 1)});
    (*this)[Conserved::kinetic].add(0.5 * (mass * v.squaredNorm()));
  }
  /// Adds a spring, or the contribution of one cell to it.
  void add_spring(double stiffness, double damping, double elongation) {
    (*this)[Conserved::stiffness].add(stiffness);
    (*this)[Conserved::damping].add(damping);
    (*this)[Conserved::elastic].add(0.5 * (stiffness * (elongation * elongation)));
  }

 private:
  void add_vector(Conserved first, const Eigen::Vector3d& terms, const Eigen::Vector3d& sizes) {
    for (int k = 0; k < 3; ++k) {
      TwofoldSum& sum = sums[static_cast<std::size_t>(first) + static_cast<std::size_t>(k)];
      const double magnitude = sum.magnitude + sizes[k];
      sum.add(terms[k]);
      sum.magnitude = magnitude;
    }
  }
};

/// The length by which a spring between x and y is too long [m]. The same bits for either order of the ends.
inline double elongation(double rest_length, const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  return std::sqrt((y - x).squaredNorm()) - rest_length;
}

/// All sums of a body except its boundary.
/// cost  O(vertices + springs)
template <class Body, class Walk>
ConservedSums sums_of(const Body& body, const Walk& walk) {
  ConservedSums sums;
  const auto& v = body.vertices;
  for (std::size_t k = 0; k < v.size(); ++k) sums.add_node(v.mass[k], v.position[k], v.velocity[k]);
  walk.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
    const auto& s = body.springs[e];
    sums.add_spring(s.stiffness, s.damping, elongation(s.rest_length, v.position[a], v.position[b]));
  });
  return sums;
}

/// The bound above for one quantity, with at most `most_cells` cells around a vertex and `more` roundings in a term;
/// 1.001 covers the rounding of the magnitudes and of the bound itself.
inline double change_bound(Conserved c, std::size_t most_cells, const TwofoldSum& before, const TwofoldSum& after,
                           const TwofoldSum& removed, std::size_t more = 0) {
  std::size_t index = more;
  switch (c) {
    case Conserved::mass: index += most_cells - 1; break;
    case Conserved::momentum_x:
    case Conserved::momentum_y:
    case Conserved::momentum_z: index += most_cells; break;
    case Conserved::spin_x:
    case Conserved::spin_y:
    case Conserved::spin_z: index += most_cells + 2; break;
    case Conserved::kinetic: index += most_cells + 3; break;
    case Conserved::stiffness:
    case Conserved::damping: index += 1; break;
    case Conserved::elastic: index += 2; break;
    case Conserved::boundary: break;
  }
  return 1.001 * gamma(index + 4) * (before.magnitude + after.magnitude + removed.magnitude);
}

/// The largest power of two of which x is a whole multiple.
/// pre  x is finite and not zero
inline double quantum(double x) {
  int exponent = 0;
  auto digits = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  exponent -= 53;
  for (; digits % 2 == 0; digits /= 2) ++exponent;
  return std::ldexp(1.0, exponent);
}

/// The drift that is allowed after so many operations, relative: the target that the project set itself. Masses are
/// computed anew from their cells, so that the actual drift does not grow: it stays below gamma of the cells around a
/// vertex.
inline double drift_target(std::size_t operations) {
  return 1e-15 * std::sqrt(static_cast<double>(std::max<std::size_t>(operations, 1)));
}

/// The expected remainder of a total, in two doubles, and the largest deviation of the body's total from it.
class Drift {
 public:
  void begin(double total) {
    expected_ = {};
    expected_.add(total);
    initial_ = total;
  }
  void remove(double part) { expected_.add(-part); }
  void compare(double total) {
    if (initial_ > 0.0) largest_ = max_or_nan(largest_, std::abs(total - expected_.value()) / initial_);
  }
  double largest() const { return largest_; }

 private:
  TwofoldSum expected_;
  double initial_ = 0.0, largest_ = 0.0;
};

}  // namespace dartboard
