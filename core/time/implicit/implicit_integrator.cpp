#include "core/time/implicit/implicit_integrator.h"

namespace dartboard {

StepResult ImplicitIntegrator::solve_one_stage(const SpringSystem& system, Motion motion, double tau,
                                               StageForce force) {
  end_.resize(motion.x.size());
  stage_.begin_step();
  for (std::size_t i = 0; i < motion.v.size(); ++i) end_.v[i] = motion.v[i];
  return stage_.solve(system, motion.x, motion.v, tau, force, end_.v, work_);
}

StepResult ImplicitIntegrator::euler_step(const SpringSystem& system, Motion motion, double h) {
  if (const StepResult result = solve_one_stage(system, motion, h, StageForce::at_end); !result.ok())
    return fail(result);
  for (std::size_t i = 0; i < motion.x.size(); ++i) end_.x[i] = motion.x[i] + h * end_.v[i];
  return end_.commit(motion, work_);
}

StepResult ImplicitIntegrator::midpoint_step(const SpringSystem& system, Motion motion, double h, StageForce force) {
  if (const StepResult result = solve_one_stage(system, motion, h / 2, force); !result.ok()) return fail(result);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    end_.x[i] = motion.x[i] + h * end_.v[i];
    end_.v[i] = 2.0 * end_.v[i] - motion.v[i];
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
