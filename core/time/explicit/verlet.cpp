#include "core/time/explicit/verlet.h"

#include <cmath>

namespace dartboard {
namespace {

// The trace is (1 + d) (1 - theta^2 / 2) and the determinant d = exp(-2 zeta theta): the limit is 2 for every zeta.
Eigen::MatrixXd amplification(double theta, double zeta) {
  const double remains = std::exp(-2.0 * zeta * theta);
  Eigen::Matrix2d drift, kick;
  drift << 1.0, theta / 2, 0.0, 1.0;
  kick << 1.0, 0.0, -theta / 2 * (1.0 + remains), remains;
  return drift * kick * drift;
}

const Scheme verlet{
    .name = "verlet",
    .what = "Stormer-Verlet, position form (drift, kick, drift)",
    .order = 2,
    .stages = 1,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .sweeps = true,
    .imaginary_limit = 2.0,
    .amplification = amplification,
    .source = "Hairer, Lubich, Wanner: Geometric numerical integration illustrated by the Stormer-Verlet method, 2003",
};

}  // namespace

const Scheme& Verlet::scheme() const { return verlet; }

void Verlet::restart() {
  terms_.forget();
  damping_.forget();
}

StepResult Verlet::step(const SpringSystem& system, Motion motion, double h) {
  const Terms terms = terms_.of(system);
  const std::size_t n = motion.x.size();
  end_.resize(n);
  a_.resize(n);
  terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) end_.x[i] = motion.x[i] + (h / 2) * motion.v[i];
  });
  accelerations(system, terms.undamped(), end_.x, motion.v, a_);
  ++work_.force_evaluations;
  if (terms.damping || terms.viscosity) {
    terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) end_.v[i] = motion.v[i] + (h / 2) * a_[i];
    });
    damping_.freeze(system, terms, end_.x);
    damping_.decay_symmetric(system, terms, h, end_.v);
    work_.damping_sweeps += 2;
    terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) end_.v[i] += (h / 2) * a_[i];
    });
  } else {
    terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) end_.v[i] = motion.v[i] + h * a_[i];
    });
  }
  terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) end_.x[i] += (h / 2) * end_.v[i];
  });
  return end_.commit(motion, work_);
}

}  // namespace dartboard
