#pragma once
// Masses and springs as plain lists, and the forces between them in any precision: the mechanics of the ODE oracle.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/held_axes.h"
#include "core/plain/problem.h"
#include "reference/elements/elastic_point.h"
#include "reference/rebuild.h"

namespace dartboard::reference {

/// Point masses joined by springs, in the mechanics of core/plain/problem.h, and by elements of elastic solids.
struct SpringNetwork {
  std::vector<double> mass;         // [kg]
  std::vector<std::uint8_t> fixed;  // by point; 1: keeps its velocity whatever acts on it
  std::vector<Spring> springs;      // any order; several may join the same two points
  std::vector<ElasticPoint> elements{};
  double viscosity = 0.0;               // [1/s]
  Eigen::Vector3d gravity{0, 0, 0};     // [m/s^2]
  std::vector<Eigen::Vector3d> pull{};  // [m/s^2] of each point, in addition to gravity; empty where nothing pulls
  std::vector<HeldAxes> held_axes{};    // of each point, along which it keeps its velocity; empty where none does
  double edge = 0.0;                    // [m] the unit of errors; 0: the mean rest length of the springs

  std::size_t point_count() const { return mass.size(); }
};

/// The network of a body at rest in the problem's mesh, by `rebuild`; points are the mesh's.
///
/// throws  InputError as rebuild does, and as `check` does
SpringNetwork spring_network(const Problem& problem);

/// throws  InputError, naming the first thing that is wrong: columns of different sizes, a mass that is not positive, a
///         spring or an element that names no point, a spring that names one twice, a number that is not finite
void check(const SpringNetwork& network);

/// The unit of errors [m]: `edge`, or the mean rest length of the springs; 1 where both are zero.
double mean_rest_length(const SpringNetwork& network);

/// The fastest rate [1/s] at which a state near x changes: the largest omega of the undamped network, its springs taken
/// as at their rest length and its elements as at rest, or the largest rate of decay, whichever is larger. By 200 steps
/// of power iteration.
double fastest_rate(const SpringNetwork& network, std::span<const Eigen::Vector3d> x);

/// The right-hand side of y' = f(y), y = (x of all points, v of all points), three numbers each.
template <class Real>
class NetworkRates {
 public:
  explicit NetworkRates(const SpringNetwork& network)
      : network_(&network), inverse_mass_(network.point_count()), viscosity_(network.viscosity) {
    for (std::size_t i = 0; i < inverse_mass_.size(); ++i) inverse_mass_[i] = Real(1) / Real(network.mass[i]);
    for (const Spring& s : network.springs)
      springs_.push_back({3 * std::size_t{s.a}, 3 * std::size_t{s.b}, s.stiffness, s.damping, s.rest_length});
  }

  std::size_t size() const { return 6 * network_->point_count(); }

  void operator()(const Real* y, Real* rate) const {
    using std::sqrt;
    const std::size_t n = 3 * network_->point_count();
    const Real *x = y, *v = y + n;
    Real *dx = rate, *dv = rate + n;
    for (std::size_t i = 0; i < n; ++i) {
      dx[i] = v[i];
      dv[i] = Real(0);
    }
    // forces first, summed in the places of the accelerations
    for (const Line& s : springs_) {
      const Real e[3] = {x[s.b] - x[s.a], x[s.b + 1] - x[s.a + 1], x[s.b + 2] - x[s.a + 2]};
      const Real length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
      if (length == Real(0)) continue;
      Real pull = s.stiffness * (length - s.rest_length);
      if (s.damping != Real(0)) {
        Real apart(0);
        for (std::size_t k = 0; k < 3; ++k) apart += (v[s.b + k] - v[s.a + k]) * e[k];
        pull += s.damping * apart / length;
      }
      pull /= length;
      for (std::size_t k = 0; k < 3; ++k) {
        dv[s.a + k] += pull * e[k];
        dv[s.b + k] -= pull * e[k];
      }
    }
    for (const ElasticPoint& point : network_->elements) {
      const Matrix3<Real> f = deformation(point, x);
      Matrix3<Real> pull = elastic_stress(point, f);
      if (point.damping_time != 0) pull += damping_stress(point, f, deformation(point, v));
      add_pull(point, pull, dv);
    }
    for (std::size_t i = 0; i < network_->point_count(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        Real& a = dv[3 * i + k];
        const auto axis = static_cast<Eigen::Index>(k);
        a = network_->fixed[i] ? Real(0)
                               : a * inverse_mass_[i] - viscosity_ * v[3 * i + k] + Real(network_->gravity[axis]);
        if (!network_->pull.empty() && !network_->fixed[i]) a += Real(network_->pull[i][axis]);
        if (!network_->held_axes.empty() && holds(network_->held_axes[i], static_cast<int>(k))) a = Real(0);
      }
  }

 private:
  struct Line {
    std::size_t a, b;  // the places of the first coordinates of the ends
    Real stiffness, damping, rest_length;
  };
  const SpringNetwork* network_;
  std::vector<Line> springs_;
  std::vector<Real> inverse_mass_;
  Real viscosity_;
};

}  // namespace dartboard::reference
