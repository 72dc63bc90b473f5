#pragma once
// The one place where what a study found is printed, written, drawn and turned into an exit status.

#include <functional>
#include <string>

#include "benchmarks/harness/manifest.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

/// What is wanted of a run.
struct Publication {
  std::string label;         // of its folder and its progress: "solvers"
  bool keeps_folder = true;  // also without `out`, in dartboard-results
  bool json = false, quick = false;
  std::string out{};
  RunFacts facts{};
};

/// What is printed: text on standard output; with `json` the numbers there, claims and manifest with them, and the text
/// on standard error. What is written: manifest.json from the start on, claims, tables, pages, pictures, samples.
///
/// returns  the exit status: 0, 1 where something disagrees, or 3 where all agrees but a picture could not be drawn
/// throws   IoError when the folder or a file cannot be written, and whatever the study throws
int publish(const Publication& how, const std::function<Report(StudyLog&)>& study);

}  // namespace dartboard
