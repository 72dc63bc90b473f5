#include "core/time/energy_momentum.h"

#include "core/time/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_energy_momentum{
    .name = "energy-momentum",
    .what = "energy and momentum conserving midpoint rule (discrete gradient)",
    .order = 2,
    .stages = 1,
    .implicit = true,
    .symmetric = true,
    .keeps_angular = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = midpoint_amplification,
    .source = "LaBudde, Greenspan 1976; Gonzalez 1996; Simo, Tarnow 1992",
};

}  // namespace

const Scheme& EnergyMomentum::scheme() const { return scheme_of_energy_momentum; }

StepResult EnergyMomentum::step(const SpringSystem& system, Motion motion, double h) {
  const std::size_t n = motion.x.size();
  end_.resize(n);
  stage_.begin_step();
  for (std::size_t i = 0; i < n; ++i) end_.v[i] = motion.v[i];
  const StepResult result =
      stage_.solve(system, motion.x, motion.v, h / 2, StageForce::discrete_gradient, end_.v, work_);
  if (!result.ok()) return fail(result);
  for (std::size_t i = 0; i < n; ++i) {
    end_.x[i] = motion.x[i] + h * end_.v[i];
    end_.v[i] = 2.0 * end_.v[i] - motion.v[i];
  }
  return end_.commit(motion, work_);
}

}  // namespace dartboard
