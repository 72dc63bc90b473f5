#include "core/time/implicit/sdirk2.h"

#include <cmath>

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_sdirk2{
    .name = "sdirk2",
    .what = "L-stable Runge-Kutta method of two equal diagonally implicit stages",
    .order = 2,
    .stages = 2,
    .implicit = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = two_stage_amplification,
    .source = "Alexander 1977",
};

}  // namespace

const Scheme& Sdirk2::scheme() const { return scheme_of_sdirk2; }

StepResult Sdirk2::step(const SpringSystem& system, Motion motion, double h) {
  const double tau = (1.0 - 1.0 / std::sqrt(2.0)) * h;
  const std::size_t n = motion.x.size();
  for (auto* state : {&end_, &start_}) state->resize(n);
  slope_x_.resize(n);
  slope_v_.resize(n);
  stage_.begin_step(work_);
  for (std::size_t i = 0; i < n; ++i) slope_x_[i] = motion.v[i];
  StepResult result = stage_.solve(system, motion.x, motion.v, tau, StageForce::at_end, slope_x_, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) {
    slope_v_[i] = (slope_x_[i] - motion.v[i]) / tau;
    start_.x[i] = motion.x[i] + (h - tau) * slope_x_[i];
    start_.v[i] = motion.v[i] + (h - tau) * slope_v_[i];
    end_.v[i] = start_.v[i] + tau * slope_v_[i];
  }
  result = stage_.solve(system, start_.x, start_.v, tau, StageForce::at_end, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) end_.x[i] = start_.x[i] + tau * end_.v[i];
  return end_.commit(motion, work_);
}

}  // namespace dartboard
