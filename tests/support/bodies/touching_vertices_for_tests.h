#pragma once
// Vertices that run into obstacles, moved by a scheme of the tests' own.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/contact_impulses.h"

namespace dartboard {

inline ContactLaw contact_law(int exponent, double restitution, double friction) {
  ContactLaw law;
  law.pressure = 2000.0;
  law.depth = 0.002;
  law.exponent = exponent;
  law.restitution = restitution;
  law.friction = friction;
  return law;
}

/// Vertices in contact, in gravity, and joined by springs if there are any: velocity Verlet around the impulses.
struct TouchingVertices {
  static constexpr double mass = 0.25, area = 0.03;  // [kg] of one, [m^2] of its sample

  struct Spring {
    std::size_t a, b;
    double length, stiffness;
  };
  std::vector<Eigen::Vector3d> x, v;
  std::vector<double> inverse_mass;
  std::vector<std::uint8_t> fixed;
  std::vector<Spring> springs;
  std::vector<SkinSample> samples;
  Eigen::Vector3d gravity{0, 0, 0};
  double time = 0.0;

  void accelerate(const ObstacleContact& contact, std::span<const Eigen::Vector3d> at,
                  std::span<Eigen::Vector3d> a) const {
    std::ranges::fill(a, Eigen::Vector3d(0, 0, 0));
    contact.add_forces({at}, a);
    for (const Spring& s : springs) {
      const Eigen::Vector3d line = at[s.b] - at[s.a], f = s.stiffness * (line.norm() - s.length) * line.normalized();
      a[s.a] += f;
      a[s.b] -= f;
    }
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i] =
          fixed.empty() || fixed[i] == 0 ? Eigen::Vector3d(inverse_mass[i] * a[i] + gravity) : Eigen::Vector3d(0, 0, 0);
  }
  void step(ObstacleContact& contact, ContactImpulses& impulses, double h) {
    const auto accelerations = [&](std::span<const Eigen::Vector3d> at, std::span<const Eigen::Vector3d>,
                                   std::span<Eigen::Vector3d> a) { accelerate(contact, at, a); };
    impulses.begin(time, h, inverse_mass, fixed, x, v, accelerations);
    std::vector<Eigen::Vector3d> a(x.size());
    accelerate(contact, x, a);
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] += (h / 2) * a[i];
      x[i] += h * v[i];
    }
    accelerate(contact, x, a);
    for (std::size_t i = 0; i < x.size(); ++i) v[i] += (h / 2) * a[i];
    impulses.end(time, h, inverse_mass, fixed, x, v);
    time += h;
  }
  double energy(const ObstacleContact& contact) const {
    double sum = contact.energy(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (inverse_mass[i] > 0.0 && (fixed.empty() || fixed[i] == 0))
        sum += (0.5 * v[i].squaredNorm() - gravity.dot(x[i])) / inverse_mass[i];
    for (const Spring& s : springs) sum += 0.5 * s.stiffness * std::pow((x[s.b] - x[s.a]).norm() - s.length, 2);
    return sum;
  }
};

inline TouchingVertices one_vertex(const Eigen::Vector3d& x, const Eigen::Vector3d& v) {
  return {{x}, {v}, {1.0 / TouchingVertices::mass}, {}, {}, {{{0}, 1, TouchingVertices::area}}, {0, 0, 0}, 0.0};
}

/// Flies towards the plane z = 0 at this velocity; returns the final velocity. Steps are a share of the contact time.
inline Eigen::Vector3d bounce(const ContactLaw& law, const Eigen::Vector3d& v, double share,
                              ContactLosses* losses = nullptr) {
  const double time = law.depth_at_impact(0.5 * TouchingVertices::mass * v[2] * v[2] / TouchingVertices::area) /
                      std::abs(v[2]),
               h = share * time;
  TouchingVertices body = one_vertex({0, 0, 2.5 * h * std::abs(v[2])}, v);
  ObstacleContact contact({law}, {{HalfSpace{}}}, body.samples);
  ContactImpulses impulses(&contact);
  while (body.x[0][2] > 0.0) body.step(contact, impulses, h);
  while (body.x[0][2] <= 0.0) body.step(contact, impulses, h);
  if (losses != nullptr) *losses = impulses.losses();
  return body.v[0];
}

}  // namespace dartboard
