#pragma once
// The log through which a study reports its progress. It knows of no terminal, no file and no exit status.

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/processes.h"
#include "benchmarks/report/report.h"

namespace dartboard {

/// This base class discards everything, which suits most tests.
class StudyLog {
 public:
  virtual ~StudyLog() = default;

  /// Announces the next task in a sentence; ends the work that was begun.
  virtual void say(const std::string& /*sentence*/) {}
  /// Records a measurement. It is kept at once, so that a run that dies keeps its samples.
  virtual void sample(const nlohmann::json& /*sample*/, const std::string& /*file*/ = "samples.jsonl",
                      const std::string& /*folder*/ = "") {}
  /// Runs this program again in a process of its own, and hands over each line that it prints. Where the study goes on
  /// after an interruption, or is derived again, a process that had come to its end is not run again (measured.h).
  /// `places` are further arguments that name files of this run alone, and are not kept.
  ///
  /// throws  ProcessError
  virtual void run(const std::vector<std::string>& arguments, const LineSink& on_line,
                   const std::vector<std::string>& places = {});
  /// A value that would be another one if it were found again, such as a time: kept as the output of a process is.
  virtual nlohmann::json once(const std::string& what, const std::function<nlohmann::json()>& find);
  /// The same for one that prints samples: each is recorded, and handed over.
  void measure(const std::vector<std::string>& arguments, const std::function<void(const nlohmann::json&)>& take,
               const std::string& folder = "", const std::vector<std::string>& places = {});
  /// `begin` starts work of that many steps and ends the work before it; `advance` says that one more step is done.
  virtual void begin(const std::string& /*label*/, std::size_t /*steps*/) {}
  virtual void advance(std::string_view /*detail*/ = "") {}
  /// A part of the report that is complete: shown, written and counted now, whatever becomes of the rest. A folder
  /// named here lies within that of the run, and keeps the claims of its parts, too.
  virtual void finished(const Report& /*part*/, const std::string& /*folder*/ = "") {}
};

}  // namespace dartboard
