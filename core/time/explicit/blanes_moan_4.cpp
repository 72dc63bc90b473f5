#include "core/time/explicit/blanes_moan_4.h"

#include <utility>

#include "core/time/method/splitting.h"

namespace dartboard {
namespace {

Eigen::MatrixXd amplification(double theta, double zeta) {
  return splitting_amplification(blanes_moan_4_splitting(), theta, zeta);
}

const Scheme blanes_moan_4{
    .name = "blanes-moan-4",
    .what = "six-stage symplectic splitting of order 4",
    .order = 4,
    .stages = 6,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .imaginary_limit = 3.1329,
    .amplification = amplification,
    .source = "Blanes, Moan: Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom methods, 2002, S6",
};

void axpy(const Terms& terms, double t, const std::vector<Eigen::Vector3d>& direction,
          std::vector<Eigen::Vector3d>& y) {
  terms.for_each_share(y.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) y[i] += t * direction[i];
  });
}

}  // namespace

const Scheme& BlanesMoan4::scheme() const { return blanes_moan_4; }

// v += t (1 - z/2 (1 - z/3 (1 - z/4))) (a - B v), the powers of B one after the other in a_ and product_.
void BlanesMoan4::damped_kick(const SpringSystem& system, const Terms& terms, double t) {
  damping_.apply(system, terms, end_.v, product_);
  axpy(terms, -1.0, product_, a_);
  axpy(terms, t, a_, end_.v);
  double weight = t;
  for (const double divisor : {2.0, 3.0, 4.0}) {
    damping_.apply(system, terms, a_, product_);
    std::swap(a_, product_);
    weight *= -t / divisor;
    axpy(terms, weight, a_, end_.v);
  }
  work_.damping_sweeps += 4;
}

StepResult BlanesMoan4::step(const SpringSystem& system, Motion motion, double h) {
  const Terms terms = terms_.of(system);
  const bool damped = terms.damping || terms.viscosity;
  const std::size_t n = motion.x.size();
  end_.resize(n);
  a_.resize(n);
  if (damped) product_.resize(n);
  end_.x.assign(motion.x.begin(), motion.x.end());
  end_.v.assign(motion.v.begin(), motion.v.end());
  const Splitting& table = blanes_moan_4_splitting();
  for (std::size_t k = 0; k < table.kicks.size(); ++k) {
    axpy(terms, table.drifts[k] * h, end_.v, end_.x);
    accelerations(system, terms.undamped(), end_.x, end_.v, a_);
    ++work_.force_evaluations;
    if (damped) {
      damping_.freeze(system, terms, end_.x);
      damped_kick(system, terms, table.kicks[k] * h);
    } else {
      axpy(terms, table.kicks[k] * h, a_, end_.v);
    }
  }
  axpy(terms, table.last_drift * h, end_.v, end_.x);
  return end_.commit(motion, work_);
}

}  // namespace dartboard
