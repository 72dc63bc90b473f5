#include "core/time/explicit/symplectic_euler.h"

#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

Eigen::MatrixXd amplification(double theta, double zeta) {
  const double remains = std::exp(-2.0 * zeta * theta);
  Eigen::Matrix2d kick, drift;
  kick << 1.0, 0.0, -theta * remains, remains;
  drift << 1.0, theta, 0.0, 1.0;
  return drift * kick;
}

const Scheme symplectic_euler{
    .name = "symplectic-euler",
    .what = "symplectic (semi-implicit) Euler",
    .order = 1,
    .stages = 1,
    .symplectic = true,
    .keeps_angular = true,
    .sweeps = true,
    .imaginary_limit = 2.0,
    .amplification = amplification,
    .source = "Hairer, Lubich, Wanner: Geometric Numerical Integration, section VI.3",
};

}  // namespace

const Scheme& SymplecticEuler::scheme() const { return symplectic_euler; }

void SymplecticEuler::restart() {
  terms_.forget();
  damping_.forget();
}

StepResult SymplecticEuler::step(const SpringSystem& system, Motion motion, double h) {
  const Terms terms = terms_.of(system);
  end_.resize(motion.x.size());
  a_.resize(motion.x.size());
  accelerations(system, terms.undamped(), motion.x, motion.v, a_);
  ++work_.force_evaluations;
  terms.for_each_share(a_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) end_.v[i] = motion.v[i] + h * a_[i];
  });
  if (terms.damping || terms.viscosity) {
    damping_.freeze(system, terms, motion.x);
    damping_.decay_once(system, terms, h, end_.v);
    ++work_.damping_sweeps;
  }
  terms.for_each_share(a_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) end_.x[i] = motion.x[i] + h * end_.v[i];
  });
  return end_.commit(motion, work_);
}

}  // namespace dartboard
