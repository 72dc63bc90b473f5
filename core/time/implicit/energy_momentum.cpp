#include "core/time/implicit/energy_momentum.h"

#include "core/time/implicit/implicit_amplification.h"

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
  return midpoint_step(system, motion, h, StageForce::discrete_gradient);
}

}  // namespace dartboard
