#pragma once
// Where a study says what it does while it works. It knows of no terminal, no file and no exit status.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "benchmarks/report/report.h"

namespace dartboard {

/// This one keeps everything to itself, which is what tests mostly want.
class StudyLog {
 public:
  virtual ~StudyLog() = default;

  /// A sentence on what comes next; ends the work that was begun.
  virtual void say(const std::string& /*sentence*/) {}
  /// Something measured. It is kept at once, so that a run that dies keeps what it had.
  virtual void sample(const nlohmann::json& /*sample*/, const std::string& /*file*/ = "samples.jsonl",
                      const std::string& /*folder*/ = "") {}
  /// Work of that many steps begins, ends the work before it; and one more step of it is done.
  virtual void begin(const std::string& /*label*/, std::size_t /*steps*/) {}
  virtual void advance(std::string_view /*detail*/ = "") {}
  /// A part of the report that is complete: shown, written and counted now, whatever becomes of the rest. A folder that
  /// is named lies within that of the run, and keeps the claims of its parts, too.
  virtual void finished(const Report& /*part*/, const std::string& /*folder*/ = "") {}
};

}  // namespace dartboard
