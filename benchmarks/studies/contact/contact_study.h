#pragma once
// `dartboard validate contact`: do bodies feel what overlaps of them, by CGAL and separating axes?

#include <cstddef>
#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ContactStudyPlan {
  std::size_t placements = 100'000;  // in all
  std::size_t looks = 100;           // of each run
  std::uint64_t seed = 1;            // of the placements
};

Report contact_study(const ContactStudyPlan& plan, StudyLog& log);

}  // namespace dartboard
