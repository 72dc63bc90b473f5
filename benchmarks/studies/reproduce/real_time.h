#pragma once
// The abstract: "still enables real-time simulation and interaction". How many tetrahedra are moved at 60 frames a
// second, with a volume removed in each.

#include <cstddef>
#include <span>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

/// A frame: 1/60 s of motion in whole steps of the paper's body, Runge-Kutta over cell arrays, after a removal and the
/// arrays built again, all the paper's way.
inline constexpr double frame_s = 1.0 / 60.0;

/// The number of steps of that size in a frame.
int steps_of_frame(double h);

/// Processor time of one frame of a body of so many tetrahedra.
struct FrameTime {
  std::size_t cells;
  double seconds;
};
void to_json(nlohmann::json& json, const FrameTime& time);
void from_json(const nlohmann::json& json, FrameTime& time);

/// The number of tetrahedra whose frame takes 1/60 s, by straight lines between the bodies measured, from the origin
/// on; the largest body where even that is faster.
/// pre  ascending in the cells, not empty
double cells_in_real_time(std::span<const FrameTime> frames);

/// One round: bodies that grow until a frame takes longer than 1/60 s, or has 64,000 tetrahedra.
std::vector<FrameTime> time_frames(double h);

/// The answer of the rounds. A quick run contradicts nothing.
/// pre  there is a round
Claim answer_real_time(std::span<const std::vector<FrameTime>> rounds, bool quick);
/// Seven rounds, timed.
Claim measure_real_time(double h, bool quick, StudyLog& log);

}  // namespace dartboard
