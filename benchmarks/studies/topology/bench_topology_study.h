#pragma once
// `dartboard bench topology`: memory, walks, checks, building and unsewing, side by side with CGAL.

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct TopologyBenchPlan {
  std::vector<std::string> bodies;  // of topology_bench_bodies()
  bool quick = false;               // fewer processes and rounds
  std::uint64_t seed = 1;           // seeds the order of turns and the random faces
};

std::vector<std::string> topology_bench_bodies();

/// No timing without agreement: a figure that differs between contenders is reported and not timed.
Report topology_bench(const TopologyBenchPlan& plan, StudyLog& log);

/// The work of one of its child processes: times groups, "BODY:FIGURE", and prints one sample per line.
void run_topology_child(const PairedOptions& paired, const std::vector<std::string>& groups);

}  // namespace dartboard
