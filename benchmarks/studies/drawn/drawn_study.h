#pragma once
// `dartboard validate drawn`: do scenes drawn over all keys keep relations that need no truth, or a scene of a user's?

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct DrawnPlan {
  std::uint64_t seed = 1, first = 0;  // of the scenes, and the number of the first
  std::size_t count = 1000;
  std::size_t broken = 10;            // faults of each scene
  bool only_choose = false;           // the scenes that have all pairs of values: no relation is tried
  std::string relation{};             // only this one; empty: all
  std::filesystem::path scene{};      // a file; empty: drawn scenes
  std::uint64_t steps = 100;          // of that scene
  std::filesystem::path folder{"."};  // for the smallest scenes that break a relation
};

/// What breaks a relation is cut down, and written into the folder unless there is a file of that name: of each
/// relation the first.
///
/// throws  InputError for an unknown relation, or a scene that is wrong; IoError
Report drawn_study(const DrawnPlan& plan, StudyLog& log);

}  // namespace dartboard
