#pragma once
// The times of a table of a load, between which it is linear.

#include <optional>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "core/scene/timeline/acting_time.h"

namespace dartboard {

/// Those of a path or a turn [s]; none of a velocity.
inline const std::vector<double>& times_of(const SceneDrive& drive) {
  return drive.turn ? drive.turn->angle.at : drive.way.at;
}

/// The first of ascending times that is between two others.
inline std::optional<double> first_between(const std::vector<double>& times, double begin, double end) {
  for (const double time : times)
    if (ActingTime::is_before(begin, time))
      return ActingTime::is_before(time, end) ? std::optional(time) : std::nullopt;
  return {};
}

}  // namespace dartboard
