#pragma once
// `dartboard validate contact`: do bodies feel every overlap that CGAL and separating axes find, and do they carry each
// other as closed forms say?

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ContactStudyPlan {
  std::size_t placements = 100'000;  // in all
  std::size_t looks = 100;           // in each run
  std::uint64_t seed = 1;            // seeds the placements, the drawn scenes and the operations
  std::size_t operations = 10'000;   // in a pressed stack
  std::size_t drawn = 1000;          // scenes
  bool every_integrator = true;      // for bounces; false: one explicit and one implicit method
  bool one_ball = false;             // pressed into a half-space; otherwise by every law, and into other cells
  // Makes the answers to questions, as run_ipctk does; empty: ipctk is not asked.
  std::function<std::string(const std::string& questions)> ipctk{};
  std::string ipctk_version{};
  std::size_t certified = 2000, shots = 100;  // placements in all, and shots, that ipctk judges
};

Report contact_study(const ContactStudyPlan& plan, StudyLog& log);

}  // namespace dartboard
