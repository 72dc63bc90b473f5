#pragma once
// The part of a quantity that an exact decay removes, and the part that remains.

namespace dartboard {

/// 1 - exp(-z) to a few roundings, without libm, so that its bits are the same on every platform.
double one_minus_exp_of_minus(double z);
/// exp(-z) likewise: to a few roundings of itself, however small it is.
double exp_of_minus(double z);

}  // namespace dartboard
