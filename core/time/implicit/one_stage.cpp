#include "core/time/implicit/one_stage.h"

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

using End = OneStageMethod::End;

const OneStageMethod backward_euler{{.name = "backward-euler",
                                     .what = "backward Euler, Newton with line search",
                                     .order = 1,
                                     .stages = 1,
                                     .implicit = true,
                                     .imaginary_limit = Scheme::unlimited,
                                     .amplification = backward_euler_amplification,
                                     .source = "Baraff, Witkin 1998, iterated to convergence"},
                                    End::of_step,
                                    StageForce::at_end};

const OneStageMethod local_global{{.name = "local-global",
                                   .what = "backward Euler by local/global iterations with a constant factor",
                                   .order = 1,
                                   .stages = 1,
                                   .implicit = true,
                                   .linearized = true,
                                   .imaginary_limit = Scheme::unlimited,
                                   .amplification = backward_euler_amplification,
                                   .source = "Liu, Bargteil, O'Brien, Kavan 2013"},
                                  End::of_step,
                                  StageForce::at_end};

const OneStageMethod implicit_midpoint{
    {.name = "implicit-midpoint",
     .what = "implicit midpoint rule",
     .order = 2,
     .stages = 1,
     .implicit = true,
     .symplectic = true,
     .symmetric = true,
     .keeps_angular = true,
     .imaginary_limit = Scheme::unlimited,
     .amplification = midpoint_amplification,
     .source = "Hairer, Lubich, Wanner: Geometric numerical integration, chapter VI"},
    End::midpoint,
    StageForce::at_end};

const OneStageMethod energy_momentum{{.name = "energy-momentum",
                                      .what = "energy and momentum conserving midpoint rule (discrete gradient)",
                                      .order = 2,
                                      .stages = 1,
                                      .implicit = true,
                                      .symmetric = true,
                                      .keeps_angular = true,
                                      .imaginary_limit = Scheme::unlimited,
                                      .amplification = midpoint_amplification,
                                      .source = "LaBudde, Greenspan 1976; Gonzalez 1996; Simo, Tarnow 1992"},
                                     End::midpoint,
                                     StageForce::discrete_gradient};

}  // namespace

StepResult OneStage::step(const SpringSystem& system, Motion motion, double h) {
  const bool to_midpoint = method_.end == End::midpoint;
  end_.resize(motion.x.size());
  stage_.begin_step(work_);
  for (std::size_t i = 0; i < motion.v.size(); ++i) end_.v[i] = motion.v[i];
  const StepResult result =
      stage_.solve(system, motion.x, motion.v, to_midpoint ? h / 2 : h, method_.force, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    end_.x[i] = motion.x[i] + h * end_.v[i];
    if (to_midpoint) end_.v[i] = 2.0 * end_.v[i] - motion.v[i];
  }
  return end_.commit(motion, work_);
}

BackwardEuler::BackwardEuler(const ImplicitOptions& options) : OneStage(backward_euler, options) {}

LocalGlobal::LocalGlobal(int iterations) : OneStage(local_global, with_iterations(iterations)) {}

ImplicitOptions LocalGlobal::with_iterations(int iterations) {
  ImplicitOptions options;
  options.solver = LinearSolver::laplacian;
  options.max_iterations = iterations;
  options.iterate_once = true;
  return options;
}

ImplicitMidpoint::ImplicitMidpoint(const ImplicitOptions& options) : OneStage(implicit_midpoint, options) {}

EnergyMomentum::EnergyMomentum(const ImplicitOptions& options) : OneStage(energy_momentum, options) {}

ImplicitOptions EnergyMomentum::to_rounding() {
  ImplicitOptions options;
  options.tolerance = 0.0;
  return options;
}

}  // namespace dartboard
