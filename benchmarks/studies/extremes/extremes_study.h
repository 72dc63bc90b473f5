#pragma once
// `dartboard extremes`: the behaviour of every integrator at the limits; `reproduce` runs it, too.

#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ExtremesPlan {
  std::string axis{};  // of the matrix, or a study; empty for all of them
  // names of study scenes or scene files, in place of the matrix and the studies
  std::vector<std::string> scenes{};
  bool quick = false;        // every third value, coarser maps, shorter runs
  bool shows_tables = true;  // else only the table of the matrix
  std::string folder{};      // subfolder of the run's for the files written; empty: the run's own
};

/// Measures what the plan names; tables appear when their study is done, which may take minutes. The runs of the matrix
/// are made in child processes, so that one that ends its process is a result, too.
///
/// throws  InputError for an unknown axis, and as find_scene
Report extremes_study(const ExtremesPlan& plan, StudyLog& log);

/// The work of such a child process: makes the runs of an axis, or of one scene, from a number on, and prints the
/// number before each and its result after it.
void run_extremes_child(const ExtremesPlan& plan, std::size_t from);

/// The names that an axis may have, parted by commas.
std::string known_extremes();

}  // namespace dartboard
