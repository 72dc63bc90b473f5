#pragma once
// `dartboard extremes`: what becomes of every integrator at the limits; `reproduce` asks, too.

#include <string>
#include <string_view>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ExtremesPlan {
  std::string axis{};        // of the matrix, or a study; empty for all of them
  bool quick = false;        // every third value, coarser maps, shorter runs
  bool shows_tables = true;  // else that of the matrix alone
  std::string folder{};      // for what is written, within that of the run; empty: there
};

/// Measures what the plan names; tables appear when their study is done, which may take minutes. The runs of the matrix
/// are made in child processes, so that one that ends its process is a result, too.
///
/// throws  InputError for an axis that there is not
Report extremes_study(const ExtremesPlan& plan, StudyLog& log);

/// What such a child process does: makes the runs of an axis from a number on, and prints the number before each and
/// its result after it.
void run_extremes_child(std::string_view axis, bool quick, std::size_t from);

/// The names that an axis may have, parted by commas.
std::string known_extremes();

}  // namespace dartboard
