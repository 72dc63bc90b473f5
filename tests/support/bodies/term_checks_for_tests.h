#pragma once
// Properties of every force term: a slope of its energy, its tangents the slopes of its forces.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/forces/force_term.h"
#include "core/plain/random.h"

namespace dartboard {

inline std::vector<Eigen::Vector3d> forces_of(const ForceTerm& term, const std::vector<Eigen::Vector3d>& x) {
  std::vector<Eigen::Vector3d> force(x.size(), Eigen::Vector3d(0, 0, 0));
  term.add_forces({x}, force);
  return force;
}

/// The tangent times w; only the pairs of a piece's own vertices.
inline std::vector<Eigen::Vector3d> product_of(const ForceTerm& term, const std::vector<Eigen::Vector3d>& x,
                                               const std::vector<Eigen::Vector3d>& w,
                                               Compression compression = Compression::exact) {
  std::vector<Eigen::Vector3d> product(x.size(), Eigen::Vector3d(0, 0, 0));
  term.for_each_tangent({x}, compression, [&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
    ASSERT_EQ(blocks.size(), n.size() * (n.size() + 1) / 2);
    for (std::size_t a = 0, k = 0; a < n.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b, ++k) {
        product[n[a]] += blocks[k] * w[n[b]];
        if (b < a) product[n[b]] += blocks[k].transpose() * w[n[a]];
      }
  });
  return product;
}

inline double dot(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}
inline double size_of(const std::vector<Eigen::Vector3d>& a) {
  double sum = 0.0;
  for (const Eigen::Vector3d& v : a) sum += v.norm();
  return sum;
}
inline std::vector<Eigen::Vector3d> moved(std::vector<Eigen::Vector3d> x, const std::vector<Eigen::Vector3d>& w,
                                          double t) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += t * w[i];
  return x;
}

/// At x, which is not at rest. Differences of a step d = 1e-4 lengths are taken at d and 2 d, so that errors of d^2
/// cancel: errors of d^4 remain, and the rounding of energies and forces over d.
inline void expect_consistent(const ForceTerm& term, const std::vector<Eigen::Vector3d>& x, double length) {
  SplitMix64 random(7);
  std::vector<Eigen::Vector3d> w(x.size());
  for (Eigen::Vector3d& v : w)
    for (double& c : v) c = random.next_signed();
  const auto force = forces_of(term, x);
  const double size = size_of(force), d = 1e-4 * length, power = dot(force, w);
  ASSERT_GT(size, 0.0);
  Eigen::Vector3d sum(0, 0, 0), torque(0, 0, 0);
  double lever = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force[i];
    torque += x[i].cross(force[i]);
    lever = std::max(lever, x[i].norm());
  }
  EXPECT_LE(sum.norm(), 1e-15 * size);
  EXPECT_LE(torque.norm(), 2e-15 * size * lever);
  const auto slope = [&](double step) {
    return (term.energy(moved(x, w, -step)) - term.energy(moved(x, w, step))) / (2 * step);
  };
  EXPECT_NEAR((4 * slope(d) - slope(2 * d)) / 3, power, 1e-8 * size);
  const auto product = product_of(term, x, w);
  const auto change = [&](double step) {
    auto down = forces_of(term, moved(x, w, -step));
    const auto up = forces_of(term, moved(x, w, step));
    for (std::size_t i = 0; i < down.size(); ++i) down[i] = (down[i] - up[i]) / (2 * step);
    return down;
  };
  const auto near = change(d), far = change(2 * d);
  double worst = 0.0, stiffest = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    worst = std::max(worst, ((4 * near[i] - far[i]) / 3 - product[i]).norm());
    stiffest = std::max(stiffest, product[i].norm());
  }
  EXPECT_LE(worst, 1e-7 * stiffest);
  EXPECT_GE(dot(product_of(term, x, w, Compression::projected), w), 0.0);
  // changes of energy, and the work of discrete forces, along a long way
  const double t = 0.05 * length, before = term.energy(x), after = term.energy(moved(x, w, t));
  const EnergyChange found = term.energy_change({x}, w, t);
  EXPECT_NEAR(found.value, after - before, 1e-13 * (before + after));
  EXPECT_GE(found.sizes, std::abs(found.value));
  const EnergyChange on_the_way = term.energy_change({x, w, t / 2}, w, t / 2);
  EXPECT_NEAR(on_the_way.value, after - term.energy(moved(x, w, t / 2)), 1e-12 * (before + after));
  std::vector<Eigen::Vector3d> discrete(x.size(), Eigen::Vector3d(0, 0, 0)), half_way = discrete;
  term.add_discrete_forces({x, w, t / 2}, discrete);
  EXPECT_NEAR(dot(discrete, w) * t, before - after, 1e-13 * (before + after));
  term.add_forces({x, w, t / 2}, half_way);
  const auto there = forces_of(term, moved(x, w, t / 2));
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LE((half_way[i] - there[i]).norm(), 1e-12 * size_of(there));
  std::vector<std::uint32_t> all(term.size());
  double shares = 0.0;
  for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
  EXPECT_NEAR(term.power(all, x, w), power, 1e-12 * size);
  for (std::size_t first = 0; first < 3; ++first) shares += term.energy(x, first, 3);
  EXPECT_NEAR(shares, before, 1e-14 * before);
  // a bound on the sum, and a constant matrix that is at least as stiff
  std::vector<double> sizes(x.size(), 0.0);
  term.add_force_sizes({x}, sizes);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_GE(sizes[i], force[i].norm() * (1 - 1e-12));
  double constant = 0.0;
  term.for_each_constant_tangent([&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
    for (std::size_t a = 0, k = 0; a < n.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b, ++k) constant += (a == b ? 1 : 2) * w[n[a]].dot(blocks[k] * w[n[b]]);
  });
  EXPECT_GE(constant * (1 + 1e-12), 0.5 * dot(product_of(term, x, w, Compression::projected), w));
}

}  // namespace dartboard
