#include "core/time/explicit/compensated_splitting.h"

#include <utility>

namespace dartboard {
namespace {

const Scheme verlet{
    .name = "verlet-compensated",
    .what =
        "Stormer-Verlet with the digits that rounding takes, for very short steps and very long runs; strong damping "
        "shortens its stable step",
    .order = 2,
    .stages = 1,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .compensated = true,
    .imaginary_limit = 2.0,
    .amplification = [](double theta, double zeta) { return splitting_amplification(verlet_splitting(), theta, zeta); },
    .source = "Hairer, McLachlan, Razakarivony: Achieving Brouwer's law with implicit Runge-Kutta methods, 2008",
};

const Scheme blanes_moan_4{
    .name = "blanes-moan-4-compensated",
    .what = "six-stage symplectic splitting of order 4 with the digits that rounding takes",
    .order = 4,
    .stages = 6,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .compensated = true,
    .imaginary_limit = 3.1329,
    .amplification = [](double theta,
                        double zeta) { return splitting_amplification(blanes_moan_4_splitting(), theta, zeta); },
    .source = "Blanes, Moan 2002, S6; Hairer, McLachlan, Razakarivony 2008",
};

}  // namespace

// v += t (1 - z/2 (1 - z/3 (1 - z/4))) (a - B v), the powers of B one after the other; every term is an increment. They
// are summed before they are added, as they would be where nothing is compensated.
void CompensatedSplitting::damped_kick(const SpringSystem& system, const Terms& terms, double t) {
  damping_.apply(system, terms, state_.v(), product_);
  for (std::size_t i = 0; i < a_.size(); ++i) a_[i] -= product_[i];
  sum_ = a_;
  double weight = 1.0;
  for (const double divisor : {2.0, 3.0, 4.0}) {
    damping_.apply(system, terms, a_, product_);
    std::swap(a_, product_);
    weight *= -t / divisor;
    for (std::size_t i = 0; i < a_.size(); ++i) sum_[i] += weight * a_[i];
  }
  work_.damping_sweeps += 4;
  state_.kick(t, sum_);
}

StepResult CompensatedSplitting::step(const SpringSystem& system, Motion motion, double h) {
  const Terms terms = terms_.of(system);
  const bool damped = terms.damping || terms.viscosity;
  a_.resize(motion.x.size());
  if (damped) product_.resize(motion.x.size());
  state_.begin(motion);
  for (std::size_t k = 0; k < splitting_.kicks.size(); ++k) {
    state_.drift(splitting_.drifts[k] * h);
    accelerations(system, terms.undamped(), state_.x(), state_.v(), a_);
    ++work_.force_evaluations;
    const double t = splitting_.kicks[k] * h;
    if (damped) {
      damping_.freeze(system, terms, state_.x());
      damped_kick(system, terms, t);
    } else {
      state_.kick(t, a_);
    }
  }
  state_.drift(splitting_.last_drift * h);
  return state_.commit(motion, work_);
}

std::unique_ptr<Integrator> make_compensated_verlet() {
  return std::make_unique<CompensatedSplitting>(verlet, verlet_splitting());
}

std::unique_ptr<Integrator> make_compensated_blanes_moan_4() {
  return std::make_unique<CompensatedSplitting>(blanes_moan_4, blanes_moan_4_splitting());
}

}  // namespace dartboard
