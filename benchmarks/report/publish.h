#pragma once
// The one place where the report of a study is printed, written, drawn and turned into an exit status.

#include <functional>
#include <string>

#include "benchmarks/harness/manifest.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

/// The requested form of a run's output.
struct Publication {
  std::string label;         // names its folder and its progress: "solvers"
  bool keeps_folder = true;  // a folder is written even without `out`, in dartboard-results
  bool json = false, quick = false;
  std::string out{};
  std::string continues{};  // the folder of a study that was interrupted: what it has measured is not measured again
  std::string derives{};    // the folder of a study: nothing is measured, and no page made
  RunFacts facts{};
};

/// Prints text on standard output; with `json` the numbers, claims and manifest there, and the text on standard error.
/// Writes manifest.json from the start on, findings and their page, claims, pictures, samples.
///
/// returns  the exit status: 0, 1 where something disagrees, or 3 where only a picture could not be drawn; 0 for one that
///          is derived again
/// throws   IoError when the folder or a file cannot be written, and whatever the study throws
int publish(const Publication& how, const std::function<Report(StudyLog&)>& study);

}  // namespace dartboard
