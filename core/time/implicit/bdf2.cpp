#include "core/time/implicit/bdf2.h"

#include <cmath>

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_bdf2{
    .name = "bdf2",
    .what = "backward differentiation formula of two steps",
    .order = 2,
    .stages = 1,
    .implicit = true,
    .one_step = false,
    .imaginary_limit = Scheme::unlimited,
    .amplification = bdf2_amplification,
    .source = "Curtiss, Hirschfelder 1952",
};

}  // namespace

const Scheme& Bdf2::scheme() const { return scheme_of_bdf2; }

StepResult Bdf2::step(const SpringSystem& system, Motion motion, double h) {
  const std::size_t n = motion.x.size();
  for (auto* state : {&end_, &start_}) state->resize(n);
  stage_.begin_step(work_);
  // Steps that should be equal may differ by rounding.
  const bool first = !(std::abs(last_h_ - h) <= 1e-12 * std::abs(h)) || last_.x.size() != n;
  const double tau = first ? h : 2.0 * h / 3.0;
  for (std::size_t i = 0; i < n; ++i) {
    start_.x[i] = motion.x[i];
    start_.v[i] = motion.v[i];
    if (system.fixed[i]) {
      start_.x[i] += (h - tau) * motion.v[i];  // it moves on by its velocity, which may be another than before
    } else if (!first) {
      start_.x[i] += (motion.x[i] - last_.x[i]) / 3.0;
      start_.v[i] += (motion.v[i] - last_.v[i]) / 3.0;
    }
    end_.v[i] = motion.v[i];
  }
  const StepResult result = stage_.solve(system, start_.x, start_.v, tau, StageForce::at_end, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) end_.x[i] = start_.x[i] + tau * end_.v[i];
  TrialState before;
  before.x.assign(motion.x.begin(), motion.x.end());
  before.v.assign(motion.v.begin(), motion.v.end());
  const StepResult committed = end_.commit(motion, work_);
  if (committed.ok()) {
    last_ = std::move(before);
    last_h_ = h;
  }
  return committed;
}

}  // namespace dartboard
