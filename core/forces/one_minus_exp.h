#pragma once
// The part of a quantity that an exact decay removes.

namespace dartboard {

/// 1 - exp(-z) to a few roundings, without libm, so that its bits are the same on every platform.
double one_minus_exp_of_minus(double z);

}  // namespace dartboard
