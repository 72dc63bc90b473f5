#include "core/time/implicit_midpoint.h"

#include "core/time/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_implicit_midpoint{
    .name = "implicit-midpoint",
    .what = "implicit midpoint rule",
    .order = 2,
    .stages = 1,
    .implicit = true,
    .symplectic = true,
    .symmetric = true,
    .keeps_angular = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = midpoint_amplification,
    .source = "Hairer, Lubich, Wanner: Geometric numerical integration, chapter VI",
};

}  // namespace

const Scheme& ImplicitMidpoint::scheme() const { return scheme_of_implicit_midpoint; }

StepResult ImplicitMidpoint::step(const SpringSystem& system, Motion motion, double h) {
  const std::size_t n = motion.x.size();
  end_.resize(n);
  stage_.begin_step();
  for (std::size_t i = 0; i < n; ++i) end_.v[i] = motion.v[i];
  const StepResult result = stage_.solve(system, motion.x, motion.v, h / 2, StageForce::at_end, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) {
    end_.x[i] = motion.x[i] + h * end_.v[i];
    end_.v[i] = 2.0 * end_.v[i] - motion.v[i];
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
