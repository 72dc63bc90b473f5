#include "core/time/implicit/backward_euler.h"

#include "core/time/implicit/implicit_amplification.h"

namespace dartboard {
namespace {

const Scheme scheme_of_backward_euler{
    .name = "backward-euler",
    .what = "backward Euler, Newton with line search",
    .order = 1,
    .stages = 1,
    .implicit = true,
    .imaginary_limit = Scheme::unlimited,
    .amplification = backward_euler_amplification,
    .source = "Baraff, Witkin 1998, iterated to convergence",
};

}  // namespace

const Scheme& BackwardEuler::scheme() const { return scheme_of_backward_euler; }

StepResult BackwardEuler::step(const SpringSystem& system, Motion motion, double h) {
  return euler_step(system, motion, h);
}

}  // namespace dartboard
