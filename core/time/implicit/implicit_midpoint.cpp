#include "core/time/implicit/implicit_midpoint.h"

#include "core/time/implicit/implicit_amplification.h"

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
  return midpoint_step(system, motion, h, StageForce::at_end);
}

}  // namespace dartboard
