#pragma once
// The pilots of one candidate, and the errors, orders and costs that are derived from them.

#include <cstddef>
#include <vector>

#include "validation/recommend/pilots.h"
#include "validation/scenes/scene_features.h"

namespace dartboard {

/// The number of checkpoints that the pilots of a scene reach: the first quarter, at least two; where there are events,
/// up to the one after the first.
std::size_t pilot_checkpoints(const TradeoffScene& scene);

/// The power of time with which the largest error so far grows, between 1/2 and 2: from the middle one of the errors to
/// the last. The errors are those at the first of `times`.
double growth_with_time(const std::vector<double>& errors, const std::vector<double>& times);

/// Pilots with h, h/2 and h/4, up to five where orders do not show, on the first quarter of the scene or up to the
/// checkpoint after its first event, or on less where that would take too long; sets the candidate's fits, or why it
/// is left out.
///
/// Richardson's estimate at each checkpoint, the observed order, and the growth of the error with time give the error
/// of the whole run. `step_s` is the approximate time of a step.
void pilot_prefix(Candidate& candidate, Pilots& pilots, double h, double step_s, double error);

/// Runs that choose their steps, with three or four tolerances from ten times the error down, over the whole duration:
/// where steps follow the motion, a part says little about the rest.
void pilot_tolerances(Candidate& candidate, Pilots& pilots, double error);

/// Where there is contact, which no part of a run foresees: pilots over the whole duration, from the longest steps on,
/// until their errors meet the one that is asked for, or until they cost more than the best so far.
///
/// A method is left out where the errors do not fall with the step: the motion is as sensitive as that.
void pilot_whole(Candidate& candidate, Pilots& pilots, double h, double error);

enum class Longer : std::uint8_t { confirmed, skipped, unstable };

/// Where the prefix was a small part of a long scene: two pilots with its coarsest steps, over as much more as there is
/// time for. They show how errors grow with time; the prediction from the prefix is corrected by that.
///
/// pre  the candidate has been solved for an error
Longer pilot_far(Candidate& candidate, Pilots& pilots);

/// Two or three pilots over the whole duration, or over as much of it as there is time for, in steps coarser than those
/// of the run, where their errors are useful.
///
/// Some instabilities take longer than the prefix to show: the limit of the step is then lowered to the failed one.
Longer pilot_longer(Candidate& candidate, Pilots& pilots);

}  // namespace dartboard
