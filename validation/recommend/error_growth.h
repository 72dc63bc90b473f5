#pragma once
// The growth of errors after the part of a motion that pilots have seen.

#include <span>

namespace dartboard {

/// The largest error of a motion over the largest of its beginning. `errors` are those of the beginning, at equal
/// distances up to its end; the whole is `times_longer`.
///
/// The errors of a regular motion grow with time, or with its square where a method loses energy or spin, or decay with
/// a motion that is damped. The power is fitted to the largest error in each of the last three octaves of time; it is
/// at least 1 where the motion lasts, else 0; at most 2. With fewer than eight errors it is that lower bound.
double beyond(std::span<const double> errors, double times_longer, bool lasts);

/// The errors of chaotic motions grow faster than the cube of time in both of the last two octaves: their rate, times
/// the time that was seen; 0 for other errors.
double exponential_growth(std::span<const double> errors);

}  // namespace dartboard
