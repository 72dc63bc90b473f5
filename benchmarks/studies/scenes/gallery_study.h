#pragma once
// `dartboard gallery`: every scene that comes with the program, run, judged and drawn.

#include <filesystem>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

Report gallery_study(const std::vector<std::filesystem::path>& scene_files, StudyLog& log);

}  // namespace dartboard
