#include "core/time/local_global.h"

#include "core/time/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_local_global{
    .name = "local-global",
    .what = "backward Euler by local/global iterations with a constant factor",
    .order = 1,
    .stages = 1,
    .implicit = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = backward_euler_amplification,
    .source = "Liu, Bargteil, O'Brien, Kavan 2013",
};

}  // namespace

const Scheme& LocalGlobal::scheme() const { return scheme_of_local_global; }

StepResult LocalGlobal::step(const SpringSystem& system, Motion motion, double h) {
  const std::size_t n = motion.x.size();
  end_.resize(n);
  stage_.begin_step();
  for (std::size_t i = 0; i < n; ++i) end_.v[i] = motion.v[i];
  const StepResult result = stage_.solve(system, motion.x, motion.v, h, StageForce::at_end, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) end_.x[i] = motion.x[i] + h * end_.v[i];
  return end_.commit(motion, work_);
}

}  // namespace dartboard
