#pragma once
// What `extremes` measures, and leaves in a folder; `reproduce` does, too.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/run_folder.h"
#include "benchmarks/studies/extremes/extremes_report.h"

namespace dartboard {

/// What is measured beside the matrix, and asked for as its axes are: "limits", "maps", ...
std::span<const ExtremeAxis> extremes_studies();

/// Called after each study, which may take minutes, with all results so far; "matrix" is the last one's name.
using StudyMade = std::function<void(const ExtremesResults& so_far, std::string_view study)>;

struct ExtremesPlan {
  std::string axis{};   // of the matrix, or a study; empty for all of them
  bool quick = false;   // every third value, coarser maps, shorter runs
  bool silent = false;  // no progress on standard error
};

/// Measures what the plan names. The runs of the matrix are made in child processes, so that one that ends its process
/// is a result, too.
ExtremesResults measure_extremes(const ExtremesPlan& plan, const StudyMade& made);

/// What such a child process does: makes the runs of an axis from a number on, and prints the number before each and
/// its result after it.
void run_extremes_child(std::string_view axis, bool quick, std::size_t from);

/// Writes the matrix, measurements, tables, claims and pictures; returns why pictures are missing, if any are.
std::vector<std::string> write_extremes(const ExtremesResults& results, const RunFolder& folder);

}  // namespace dartboard
