#pragma once
// How errors go on growing after what pilots have seen of a motion.

#include <span>

namespace dartboard {

/// The largest error of a motion over the largest of its beginning, whose errors these are, at equal distances up to
/// its end; the whole is `times_longer`.
///
/// The errors of a regular motion grow with time, or with its square where a method loses energy or spin, or decay with
/// a motion that is damped. The power is read off the largest error in each of the last three octaves of time; it is at
/// least 1 where the motion lasts, and 0 else; at most 2. Of fewer than eight errors nothing is read off.
double beyond(std::span<const double> errors, double times_longer, bool lasts);

/// Growth faster than the cube of time in both of the last two octaves is that of chaotic motions: its rate, times the
/// time that was seen; 0 where there is none.
double exponential_growth(std::span<const double> errors);

}  // namespace dartboard
