#include "core/time/implicit/local_global.h"

#include "core/time/implicit/implicit_amplification.h"

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
  return euler_step(system, motion, h);
}

}  // namespace dartboard
